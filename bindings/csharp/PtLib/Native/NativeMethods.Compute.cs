using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    // The C interface: computations.
    internal static unsafe partial class NativeMethods
    {
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_compute_options_init(
            NativeComputeOptions* options, UIntPtr structSize);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_compute(
            IntPtr graph, ulong block, uint outPort, NativeComputeOptions* options,
            IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_compute_into(
            IntPtr graph, ulong block, uint outPort, NativeComputeOptions* options, void* pixels,
            UIntPtr size, UIntPtr rowStride, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_compute_bands(
            IntPtr graph, ulong block, uint outPort, NativeComputeOptions* options, uint bandRows,
            IntPtr onBand, void* userData, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_write_files(
            IntPtr graph, NativeComputeOptions* options, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_compute_start(
            IntPtr graph, ulong block, uint outPort, NativeComputeOptions* options,
            IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_job_poll(IntPtr job, NativeProgress* inout);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_job_wait(
            IntPtr job, long timeoutMs, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_job_release(IntPtr job);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_cancel_create(IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_cancel_request(IntPtr cancel);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_cancel_is_requested(IntPtr cancel);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern IntPtr ptl_cancel_retain(IntPtr cancel);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_cancel_release(IntPtr cancel);
    }
}
