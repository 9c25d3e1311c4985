using System;
using System.Runtime.InteropServices;

#pragma warning disable 649 // C writes the fields that nobody writes here

// The structs of the C interface: what goes into calls and what comes out. A test
// compares their sizes with those of the library.
namespace PtLib.Native
{
    /// <summary>ptl_fault</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeFault
    {
        internal uint StructSize;
        internal int Status;
        internal uint Line;
        internal uint Column;
        internal ulong Block;
        internal byte* Param;
        internal byte* Message;
    }

    /// <summary>ptl_engine_options</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeEngineOptions
    {
        internal uint StructSize;
        internal uint Flags;
        internal uint Threads;
        internal uint Reserved0;
        internal ulong CacheBytes;
        internal ulong MaxMemoryBytes;
        internal ulong MaxFileBytes;
        internal ulong MaxReadBytes;
        internal uint MaxBlocks;
        internal uint MaxConnections;
        internal uint MaxTextBytes;
        internal uint MaxTextSymbols;
        internal uint MaxImageSide;
        internal uint MaxFaults;
        internal uint ReadFolderCount;
        internal uint WriteFolderCount;
        internal byte** ReadFolders;
        internal byte** WriteFolders;
    }

    /// <summary>ptl_scan_report</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeScanReport
    {
        internal uint StructSize;
        internal int Status;
        internal byte* Path;
        internal byte* PluginId;
        internal byte* PluginVersion;
        internal byte* BuiltWith;
        internal byte* Message;
        internal uint BlockCount;
        internal uint Reserved0;
    }

    /// <summary>ptl_graph_info</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeGraphInfo
    {
        internal uint StructSize;
        internal uint Width;
        internal uint Height;
        internal uint Supersampling;
        internal uint Precision;
        internal uint BlockCount;
        internal ulong Seed;
    }

    /// <summary>ptl_compute_options</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeComputeOptions
    {
        internal uint StructSize;
        internal uint Flags;
        internal uint Width;
        internal uint Height;
        internal uint Format;
        internal uint Threads;
        internal ulong Seed;
        internal ulong MemoryLimit;
        internal fixed double Region[4];
        internal uint ProgressIntervalMs;
        internal uint Supersampling;
        internal uint Precision;
        internal uint Reserved0;
        internal IntPtr Cancel;
        internal IntPtr Progress;
        internal void* UserData;
        internal void* Reserved1;
    }

    /// <summary>ptl_progress</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeProgress
    {
        internal uint StructSize;
        internal uint Stage;
        internal ulong UnitsDone;
        internal ulong UnitsTotal;
        internal double Fraction;
        internal ulong Block;
    }

    /// <summary>ptl_band</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeBand
    {
        internal uint StructSize;
        internal uint FirstRow;
        internal uint Rows;
        internal uint Width;
        internal uint Format;
        internal uint Reserved0;
        internal UIntPtr RowStride;
        internal void* Pixels;
    }

    /// <summary>ptl_image_info</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeImageInfo
    {
        internal uint StructSize;
        internal uint Format;
        internal uint Width;
        internal uint Height;
        internal uint Channels;
        internal uint BytesPerChannel;
        internal uint ColorSpace;
        internal uint Origin;
        internal UIntPtr RowStride;
        internal UIntPtr SizeBytes;
    }
}
