using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    // The C interface: engines, plug-ins and block types.
    internal static unsafe partial class NativeMethods
    {
        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_engine_options_init(
            NativeEngineOptions* options, UIntPtr structSize);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_engine_create(
            NativeEngineOptions* options, IntPtr* result, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern IntPtr ptl_engine_retain(IntPtr engine);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern void ptl_engine_release(IntPtr engine);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_engine_set_log(
            IntPtr engine, int minLevel, IntPtr log, void* userData, IntPtr freeUserData,
            IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_engine_load_plugin(IntPtr engine, byte* path, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_engine_scan_plugins(
            IntPtr engine, byte* folders, IntPtr report, void* userData, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_engine_register_plugin(
            IntPtr engine, IntPtr entry, IntPtr* error);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint ptl_engine_block_type_count(IntPtr engine);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern IntPtr ptl_engine_block_type_at(IntPtr engine, uint index);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern IntPtr ptl_engine_find_block_type(IntPtr engine, byte* id);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* ptl_block_type_id(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* ptl_block_type_name(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* ptl_block_type_category(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* ptl_block_type_doc(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern byte* ptl_block_type_plugin(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint ptl_block_type_flags(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint ptl_block_type_param_count(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint ptl_block_type_input_count(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern uint ptl_block_type_output_count(IntPtr blockType);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_block_type_param_info(
            IntPtr blockType, uint index, NativeParamInfo* inout);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_block_type_input_info(
            IntPtr blockType, uint index, NativePortInfo* inout);

        [DllImport(Library, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        internal static extern int ptl_block_type_output_info(
            IntPtr blockType, uint index, NativePortInfo* inout);
    }
}
