using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    // The C interface: graphs.
    internal static unsafe partial class NativeMethods
    {
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_create(IntPtr engine, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_clone(IntPtr graph, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_load(
            IntPtr engine, void* data, UIntPtr size, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_load_file(
            IntPtr engine, byte* path, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_save(IntPtr graph, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern IntPtr ptl_graph_retain(IntPtr graph);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_graph_release(IntPtr graph);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint ptl_graph_warning_count(IntPtr graph);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_warning_at(
            IntPtr graph, uint index, NativeFault* inout);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_get_info(
            IntPtr graph, NativeGraphInfo* inout, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_size(
            IntPtr graph, uint width, uint height, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_seed(IntPtr graph, ulong seed, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_supersampling(
            IntPtr graph, uint level, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_precision(
            IntPtr graph, uint precision, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_folder(IntPtr graph, byte* folder, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_add_block(
            IntPtr graph, byte* typeId, ulong* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_remove_block(IntPtr graph, ulong block, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint ptl_graph_block_count(IntPtr graph);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern ulong ptl_graph_block_at(IntPtr graph, uint index);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern ulong ptl_graph_find_block(IntPtr graph, byte* fileId);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern ulong ptl_graph_main_result(IntPtr graph);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_block_type(
            IntPtr graph, ulong block, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_block_id(
            IntPtr graph, ulong block, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_block_type_id(
            IntPtr graph, ulong block, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_connect(
            IntPtr graph, ulong src, uint outPort, ulong dst, uint inPort, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_disconnect(
            IntPtr graph, ulong dst, uint inPort, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_input_source(
            IntPtr graph, ulong dst, uint inPort, ulong* src, uint* outPort, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_validate(IntPtr graph, ulong output, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_float(
            IntPtr graph, ulong block, byte* param, double* values, uint count, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_int(
            IntPtr graph, ulong block, byte* param, long value, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_text(
            IntPtr graph, ulong block, byte* param, byte* utf8, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_reset_param(
            IntPtr graph, ulong block, byte* param, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_get_float(
            IntPtr graph, ulong block, byte* param, double* values, uint capacity, uint* count,
            IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_get_int(
            IntPtr graph, ulong block, byte* param, long* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_get_text(
            IntPtr graph, ulong block, byte* param, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_set_block_seed(
            IntPtr graph, ulong block, ulong seed, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_reset_block_seed(
            IntPtr graph, ulong block, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_graph_get_block_seed(
            IntPtr graph, ulong block, ulong* seed, int* isOwn, IntPtr* error);
    }
}
