using System;
using System.Runtime.CompilerServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>Points, each perhaps with more data.</summary>
    public sealed unsafe class Points : StreamedValue
    {
        internal Points(IntPtr value)
            : base(value, Bytes(value))
        {
        }

        /// <summary>How many points there are.</summary>
        public int Count
        {
            get
            {
                using (var value = Use())
                {
                    return (int)Read(value.Pointer).PointCount;
                }
            }
        }

        /// <summary>Makes points of an array, which is copied and checked during the call.
        /// </summary>
        /// <typeparam name="T">The struct of a point: floats and uints only.</typeparam>
        /// <param name="elements">The points.</param>
        /// <param name="streams">What the parts of a point mean.</param>
        /// <returns>The points; dispose of them.</returns>
        /// <exception cref="PtLibException">An array is null, a number is not finite or a normal
        /// has no length: the message names the first wrong one and how many there are.
        /// </exception>
        public static Points FromElements<T>(T[] elements, params VertexStream[] streams)
            where T : struct
        {
            Loader.Ensure();
            return Make(elements, streams);
        }

        internal override void Streams(
            out NativeStream** streams, out uint count, out uint elements)
        {
            using (var value = Use())
            {
                var data = Read(value.Pointer);
                streams = data.Streams;
                count = data.StreamCount;
                elements = data.PointCount;
            }
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static Points Make<T>(T[] elements, VertexStream[] streams)
            where T : struct
        {
            using (var pinned = new Pinned<T>(elements, nameof(elements)))
            using (var list = new StreamList(
                streams, pinned.Address, Blittable<T>.Size, elements.Length == 0, nameof(streams)))
            {
                var data = new NativePointsData
                {
                    StructSize = (uint)sizeof(NativePointsData),
                    PointCount = (uint)elements.Length,
                    Streams = list.Pointer,
                    StreamCount = list.Count,
                };
                IntPtr value, error;
                var status = NativeMethods.ptl_value_from_points(
                    &data, 0, IntPtr.Zero, null, &value, &error);
                Errors.Check(status, error);
                return new Points(value);
            }
        }

        private static long Bytes(IntPtr value)
        {
            var data = Read(value);
            long words = 0;
            for (uint i = 0; i < data.StreamCount; i++)
            {
                words += (long)data.Streams[i]->Components * data.PointCount;
            }
            return words * 4;
        }

        private static NativePointsData Read(IntPtr value)
        {
            var data = new NativePointsData { StructSize = (uint)sizeof(NativePointsData) };
            IntPtr error;
            var status = NativeMethods.ptl_value_points(value, &data, &error);
            Errors.Check(status, error);
            return data;
        }
    }
}
