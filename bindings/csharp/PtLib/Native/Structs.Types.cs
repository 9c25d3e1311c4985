using System;
using System.Runtime.InteropServices;

#pragma warning disable 649 // C writes the fields that nobody writes here

// The structs of the C interface: descriptions of block types. A test
// compares their sizes with those of the library.
namespace PtLib.Native
{
    /// <summary>ptl_param_info</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeParamInfo
    {
        internal uint StructSize;
        internal uint Type;
        internal uint Flags;
        internal uint Components;
        internal byte* Id;
        internal byte* Name;
        internal byte* Doc;
        internal byte* Unit;
        internal double Min;
        internal double Max;
        internal double SoftMin;
        internal double SoftMax;
        internal double Step;
        internal fixed double DefaultValue[4];
        internal byte* DefaultText;
        internal byte** EnumIds;
        internal byte** EnumDocs;
        internal uint EnumCount;
        internal uint Reserved0;
    }

    /// <summary>ptl_port_info</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativePortInfo
    {
        internal uint StructSize;
        internal uint Kind;
        internal uint Flags;
        internal uint Channels;
        internal byte* Id;
        internal byte* Name;
    }
}
