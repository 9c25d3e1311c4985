using System;
using System.Runtime.InteropServices;

#pragma warning disable 649 // C writes the fields that nobody writes here

// The structs of the C interface: values on wires. A test
// compares their sizes with those of the library.
namespace PtLib.Native
{
    /// <summary>ptl_stream</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeStream
    {
        internal uint StructSize;
        internal uint Type;
        internal uint Components;
        internal uint Flags;
        internal byte* Id;
        internal void* Data;
        internal UIntPtr Stride;
    }

    /// <summary>ptl_mesh_data</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeMeshData
    {
        internal uint StructSize;
        internal uint Flags;
        internal uint VertexCount;
        internal uint IndexCount;
        internal uint* Indices;
        internal NativeStream** Streams;
        internal uint StreamCount;
        internal uint Reserved0;
        internal fixed float BoundsMin[3];
        internal fixed float BoundsMax[3];
    }

    /// <summary>ptl_points_data</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativePointsData
    {
        internal uint StructSize;
        internal uint Flags;
        internal uint PointCount;
        internal uint StreamCount;
        internal NativeStream** Streams;
        internal fixed float BoundsMin[3];
        internal fixed float BoundsMax[3];
    }

    /// <summary>ptl_strands_data</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeStrandsData
    {
        internal uint StructSize;
        internal uint Flags;
        internal uint StrandCount;
        internal uint PointCount;
        internal uint* FirstPoint;
        internal NativeStream** PointStreams;
        internal NativeStream** StrandStreams;
        internal uint PointStreamCount;
        internal uint StrandStreamCount;
        internal fixed float BoundsMin[3];
        internal fixed float BoundsMax[3];
    }

    /// <summary>ptl_gradient_data</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeGradientData
    {
        internal uint StructSize;
        internal uint StopCount;
        internal GradientStop* Stops;
    }

    /// <summary>ptl_text_data</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeTextData
    {
        internal uint StructSize;
        internal uint Flags;
        internal byte* Text;
        internal UIntPtr Size;
    }

    /// <summary>ptl_image_data</summary>
    [StructLayout(LayoutKind.Sequential)]
    internal unsafe struct NativeImageData
    {
        internal uint StructSize;
        internal uint Format;
        internal uint Width;
        internal uint Height;
        internal void* Pixels;
        internal UIntPtr RowStride;
    }
}
