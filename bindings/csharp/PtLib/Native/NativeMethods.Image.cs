using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    // The C interface: images.
    internal static unsafe partial class NativeMethods
    {
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_image_get_info(IntPtr image, NativeImageInfo* inout);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void* ptl_image_pixels(IntPtr image, UIntPtr* size);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_image_copy(
            IntPtr image, uint format, void* dst, UIntPtr size, UIntPtr rowStride,
            IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_image_save(IntPtr image, byte* path, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern IntPtr ptl_image_retain(IntPtr image);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_image_release(IntPtr image);
    }
}
