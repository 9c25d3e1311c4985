using System;
using System.Runtime.InteropServices;

#pragma warning disable 649 // C writes the fields that nobody writes here

// The tables of ptlib_plugin.h.
namespace PtLib.Blocks
{
    /// <summary>ptlp_job</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeCall
    {
        internal uint StructSize;
        internal uint Flags;
        internal void* Data;
        internal IntPtr IsCancelled;
        internal IntPtr Report;
        internal IntPtr SetError;
        internal IntPtr Warn;
    }

    /// <summary>ptlp_port</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativePort
    {
        internal uint StructSize;
        internal uint Kind;
        internal uint Flags;
        internal uint Planes;
        internal uint PlanesInput;
        internal uint Reserved0;
        internal byte* Id;
        internal byte* Doc;
    }

    /// <summary>ptlp_param</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeParam
    {
        internal uint StructSize;
        internal uint Type;
        internal uint Flags;
        internal uint ChoiceCount;
        internal double Min;
        internal double Max;
        internal double SoftMin;
        internal double SoftMax;
        internal double DefaultValue;
        internal byte* Id;
        internal byte* Doc;
        internal byte* Unit;
        internal byte* DefaultText;
        internal byte** ChoiceIds;
        internal byte** ChoiceDocs;
    }

    /// <summary>ptlp_value</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeParamValue
    {
        internal uint Type;
        internal uint Reserved0;
        internal long Integer;
        internal double Number;
        internal byte* Text;
        internal void* Reserved1;
    }

    /// <summary>ptlp_tile</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeTile
    {
        internal uint StructSize;
        internal uint Channels;
        internal uint X;
        internal uint Y;
        internal uint Width;
        internal uint Height;
        internal uint ImageWidth;
        internal uint ImageHeight;
        internal UIntPtr RowStride;
        internal float* Red;
        internal float* Green;
        internal float* Blue;
        internal float* Alpha;
    }

    /// <summary>ptlp_wire</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeWire
    {
        internal uint StructSize;
        internal uint Kind;
        internal void* Value;
    }

    /// <summary>ptlp_setup</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeSetup
    {
        internal uint StructSize;
        internal uint Flags;
        internal uint Width;
        internal uint Height;
        internal uint Precision;
        internal uint ValueCount;
        internal uint InputCount;
        internal uint Reserved0;
        internal ulong Seed;
        internal NativeParamValue** Values;
        internal NativeWire** Inputs;
    }

    /// <summary>ptlp_block</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeBlock
    {
        internal uint StructSize;
        internal uint Version;
        internal uint Shape;
        internal uint ThreadMode;
        internal uint Flags;
        internal uint InputCount;
        internal uint OutputCount;
        internal uint ParamCount;
        internal byte* Id;
        internal byte* Name;
        internal byte* Category;
        internal byte* Doc;
        internal byte* TilingException;
        internal byte* InPixels;
        internal NativePort** Inputs;
        internal NativePort** Outputs;
        internal NativeParam** Params;
        internal IntPtr UserData;
        internal IntPtr Create;
        internal IntPtr Destroy;
        internal IntPtr Prepare;
        internal IntPtr Compute;
        internal IntPtr Memory;
    }

    /// <summary>ptlp_entry</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeEntry
    {
        internal uint StructSize;
        internal uint AbiMajor;
        internal uint AbiMinor;
        internal uint Flags;
        internal byte* Id;
        internal byte* Name;
        internal byte* Vendor;
        internal byte* Version;
        internal byte* License;
        internal byte* BuiltWith;
        internal IntPtr Init;
        internal IntPtr Deinit;
        internal IntPtr GetExtension;
        internal NativeBlock** Blocks;
        internal uint BlockCount;
        internal uint Reserved0;
    }
}
