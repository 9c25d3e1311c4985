using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    // The C interface: values on wires.
    internal static unsafe partial class NativeMethods
    {
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_from_mesh(
            NativeMeshData* mesh, uint flags, IntPtr free, void* userData, IntPtr* result,
            IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_from_points(
            NativePointsData* points, uint flags, IntPtr free, void* userData, IntPtr* result,
            IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_from_strands(
            NativeStrandsData* strands, uint flags, IntPtr free, void* userData, IntPtr* result,
            IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_from_text(
            NativeTextData* text, uint flags, IntPtr free, void* userData, IntPtr* result,
            IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_from_gradient(
            NativeGradientData* gradient, uint flags, IntPtr free, void* userData,
            IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_from_image(
            NativeImageData* image, uint flags, IntPtr free, void* userData, IntPtr* result,
            IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint ptl_value_kind(IntPtr value);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern IntPtr ptl_value_retain(IntPtr value);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_value_release(IntPtr value);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_mesh(
            IntPtr value, NativeMeshData* inout, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_points(
            IntPtr value, NativePointsData* inout, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_strands(
            IntPtr value, NativeStrandsData* inout, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_text(
            IntPtr value, NativeTextData* inout, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_gradient(
            IntPtr value, NativeGradientData* inout, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_value_image(
            IntPtr value, uint format, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_input(
            IntPtr graph, ulong block, IntPtr value, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern ulong ptl_graph_find_input(IntPtr graph, byte* name);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_compute_value(
            IntPtr graph, ulong block, uint outPort, NativeComputeOptions* options,
            IntPtr* result, IntPtr* error);
    }
}
