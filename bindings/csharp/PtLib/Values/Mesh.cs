using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>Triangles.</summary>
    public sealed unsafe class Mesh : StreamedValue
    {
        internal Mesh(IntPtr value)
            : base(value, Bytes(value))
        {
        }

        /// <summary>How many vertices it has.</summary>
        public int VertexCount
        {
            get { return (int)Data().VertexCount; }
        }

        /// <summary>How many triangles it has.</summary>
        public int TriangleCount
        {
            get { return (int)Data().IndexCount / 3; }
        }

        /// <summary>
        /// Makes a mesh of vertices and indices, which are copied and checked during the call.
        /// Normals of another length than 1 are made so.
        /// </summary>
        /// <typeparam name="T">The struct of a vertex: floats and uints only, such as
        /// <see cref="VertexPTN"/>.</typeparam>
        /// <param name="vertices">The vertices.</param>
        /// <param name="indices">Numbers of vertices, three for each triangle.</param>
        /// <param name="streams">What the parts of a vertex mean, such as
        /// <see cref="VertexPTN.Streams"/>.</param>
        /// <returns>The mesh; dispose of it.</returns>
        /// <exception cref="PtLibException">An array is null, an index is no number of a vertex, a
        /// number is not finite: the message names the first wrong one and how many there are.
        /// </exception>
        public static Mesh FromVertices<T>(
            T[] vertices, uint[] indices, params VertexStream[] streams)
            where T : struct
        {
            Loader.Ensure();
            return Make(vertices, indices, streams, false);
        }

        /// <summary>
        /// The same without a copy: both arrays stay pinned, and must not change, until the last
        /// value or graph that needs them is gone.
        /// </summary>
        /// <typeparam name="T">As in <see cref="FromVertices{T}"/>.</typeparam>
        /// <param name="vertices">The vertices.</param>
        /// <param name="indices">Numbers of vertices, three for each triangle.</param>
        /// <param name="streams">What the parts of a vertex mean.</param>
        /// <returns>The mesh; dispose of it.</returns>
        /// <exception cref="PtLibException">As in <see cref="FromVertices{T}"/>.</exception>
        public static Mesh Lend<T>(T[] vertices, uint[] indices, params VertexStream[] streams)
            where T : struct
        {
            Loader.Ensure();
            return Make(vertices, indices, streams, true);
        }

        /// <summary>The numbers of vertices, three for each triangle.</summary>
        /// <returns>A new array.</returns>
        public uint[] IndicesToArray()
        {
            using (Use())
            {
                var data = Data();
                var indices = new uint[data.IndexCount];
                for (var i = 0; i < indices.Length; i++)
                {
                    indices[i] = data.Indices[i];
                }
                return indices;
            }
        }

#if NET8_0_OR_GREATER
        /// <summary>The numbers of vertices in the memory of the library; as
        /// <see cref="StreamedValue.AsSpan{T}"/>.</summary>
        public ReadOnlySpan<uint> Indices
        {
            get
            {
                var data = Data();
                return new ReadOnlySpan<uint>(data.Indices, checked((int)data.IndexCount));
            }
        }
#endif

        internal override void Streams(
            out NativeStream** streams, out uint count, out uint elements)
        {
            var data = Data();
            streams = data.Streams;
            count = data.StreamCount;
            elements = data.VertexCount;
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static Mesh Make<T>(
            T[] vertices, uint[] indices, VertexStream[] streams, bool isLent)
            where T : struct
        {
            var vertexCount = Length(vertices, nameof(vertices));
            var indexCount = Length(indices, nameof(indices));
            var pins = new[]
            {
                Pinned<T>.Pin(vertices, nameof(vertices)),
                Pinned<uint>.Pin(indices, nameof(indices)),
            };
            var loan = new Loan(pins);
            var isHandedOver = false;
            try
            {
                using (var list = new StreamList(
                    streams, pins[0].AddrOfPinnedObject(), Blittable<T>.Size, vertexCount == 0,
                    nameof(streams)))
                {
                    var data = new NativeMeshData
                    {
                        StructSize = (uint)sizeof(NativeMeshData),
                        VertexCount = vertexCount,
                        IndexCount = indexCount,
                        Indices =
                            indexCount == 0 ? null : (uint*)pins[1].AddrOfPinnedObject(),
                        Streams = list.Pointer,
                        StreamCount = list.Count,
                    };
                    IntPtr value, error;
                    // From here on the library ends the loan, also if it fails.
                    var userData = isLent ? LendOut(pins) : null;
                    isHandedOver = isLent;
                    var status = NativeMethods.ptl_value_from_mesh(
                        &data, isLent ? Borrow : 0, isLent ? Callbacks.Free : IntPtr.Zero,
                        userData, &value, &error);
                    Errors.Check(status, error);
                    return new Mesh(value);
                }
            }
            finally
            {
                if (!isHandedOver)
                {
                    loan.End();
                }
            }
        }

        private static long Bytes(IntPtr value)
        {
            var data = Read(value);
            long words = data.IndexCount;
            for (uint i = 0; i < data.StreamCount; i++)
            {
                words += (long)data.Streams[i]->Components * data.VertexCount;
            }
            return words * 4;
        }

        private static NativeMeshData Read(IntPtr value)
        {
            var data = new NativeMeshData { StructSize = (uint)sizeof(NativeMeshData) };
            IntPtr error;
            var status = NativeMethods.ptl_value_mesh(value, &data, &error);
            Errors.Check(status, error);
            return data;
        }

        private NativeMeshData Data()
        {
            using (var value = Use())
            {
                return Read(value.Pointer);
            }
        }
    }
}
