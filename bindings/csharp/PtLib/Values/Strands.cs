using System;
using System.Runtime.CompilerServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>Polylines, such as hairs. Its streams are those of the points.</summary>
    public sealed unsafe class Strands : StreamedValue
    {
        internal Strands(IntPtr value)
            : base(value, Bytes(value))
        {
        }

        /// <summary>How many strands there are.</summary>
        public int Count
        {
            get { return (int)Data().StrandCount; }
        }

        /// <summary>Points of all strands together.</summary>
        public int PointCount
        {
            get { return (int)Data().PointCount; }
        }

        /// <summary>Makes strands of arrays, which are copied and checked during the call.
        /// </summary>
        /// <typeparam name="T">The struct of a point: floats and uints only.</typeparam>
        /// <param name="points">The points of all strands.</param>
        /// <param name="firstPoint">Strand i has the points from firstPoint[i] to before
        /// firstPoint[i + 1]: one entry more than strands, the last is the number of points. Each
        /// strand has at least two points.</param>
        /// <param name="streams">What the parts of a point mean.</param>
        /// <returns>The strands; dispose of them.</returns>
        /// <exception cref="PtLibException">An array is null or of the wrong length, or a number is
        /// wrong: the message names the first one.</exception>
        public static Strands FromPoints<T>(
            T[] points, uint[] firstPoint, params VertexStream[] streams)
            where T : struct
        {
            Loader.Ensure();
            return Make(points, firstPoint, streams);
        }

        /// <summary>Where each strand begins: one entry more than strands.</summary>
        /// <returns>A new array.</returns>
        public uint[] FirstPointToArray()
        {
            using (Use())
            {
                var data = Data();
                var first = new uint[data.StrandCount + 1];
                for (var i = 0; i < first.Length && data.FirstPoint != null; i++)
                {
                    first[i] = data.FirstPoint[i];
                }
                return first;
            }
        }

        internal override void Streams(
            out NativeStream** streams, out uint count, out uint elements)
        {
            var data = Data();
            streams = data.PointStreams;
            count = data.PointStreamCount;
            elements = data.PointCount;
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static Strands Make<T>(T[] points, uint[] firstPoint, VertexStream[] streams)
            where T : struct
        {
            if (Length(firstPoint, nameof(firstPoint)) == 0)
            {
                throw new PtLibException(
                    Status.InvalidArgument,
                    "firstPoint is empty, it needs one entry more than there are strands.",
                    nameof(firstPoint));
            }
            using (var pinned = new Pinned<T>(points, nameof(points)))
            using (var first = new Pinned<uint>(firstPoint, nameof(firstPoint)))
            using (var list = new StreamList(
                streams, pinned.Address, Blittable<T>.Size, points.Length == 0, nameof(streams)))
            {
                var data = new NativeStrandsData
                {
                    StructSize = (uint)sizeof(NativeStrandsData),
                    StrandCount = (uint)firstPoint.Length - 1,
                    PointCount = (uint)points.Length,
                    FirstPoint = (uint*)first.Address,
                    PointStreams = list.Pointer,
                    PointStreamCount = list.Count,
                };
                IntPtr value, error;
                var status = NativeMethods.ptl_value_from_strands(
                    &data, 0, IntPtr.Zero, null, &value, &error);
                Errors.Check(status, error);
                return new Strands(value);
            }
        }

        private static long Bytes(IntPtr value)
        {
            var data = Read(value);
            long words = data.StrandCount;
            for (uint i = 0; i < data.PointStreamCount; i++)
            {
                words += (long)data.PointStreams[i]->Components * data.PointCount;
            }
            return words * 4;
        }

        private static NativeStrandsData Read(IntPtr value)
        {
            var data = new NativeStrandsData { StructSize = (uint)sizeof(NativeStrandsData) };
            IntPtr error;
            var status = NativeMethods.ptl_value_strands(value, &data, &error);
            Errors.Check(status, error);
            return data;
        }

        private NativeStrandsData Data()
        {
            using (var value = Use())
            {
                return Read(value.Pointer);
            }
        }
    }
}
