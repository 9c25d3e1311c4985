using System;
using System.Collections.Generic;
using System.Globalization;
using PtLib.Native;

namespace PtLib
{
    /// <summary>A value that consists of streams: points, a mesh or strands.</summary>
    public abstract unsafe class StreamedValue : Value
    {
        internal StreamedValue(IntPtr value, long bytes)
            : base(value, bytes)
        {
        }

        /// <summary>The ids of its streams.</summary>
        public IReadOnlyList<string> StreamIds
        {
            get
            {
                using (Use())
                {
                    var ids = new List<string>();
                    NativeStream** streams;
                    uint count, elements;
                    Streams(out streams, out count, out elements);
                    for (uint i = 0; i < count; i++)
                    {
                        ids.Add(Utf8.Read(streams[i]->Id));
                    }
                    return ids;
                }
            }
        }

        /// <summary>The data of a stream, copied.</summary>
        /// <typeparam name="T">The struct of an element: as many floats or uints as it has numbers,
        /// such as <see cref="Point3"/> for positions.</typeparam>
        /// <param name="id">The id of the stream.</param>
        /// <returns>A new array with an element for each point or vertex.</returns>
        /// <exception cref="PtLibException">There is no such stream, or its elements have another
        /// size.</exception>
        public T[] ToArray<T>(string id)
            where T : struct
        {
            using (Use())
            {
                uint elements;
                var stream = Find(id, Blittable<T>.Size, out elements);
                var array = new T[elements];
                using (var pinned = new Pinned<T>(array, nameof(id)))
                {
                    Copy(stream, elements, (byte*)pinned.Address);
                }
                return array;
            }
        }

#if NET8_0_OR_GREATER
        /// <summary>
        /// The data of a stream in the memory of the library, or where a loan is. The span must
        /// not be used after this was disposed of, and this has to be kept (GC.KeepAlive) as long
        /// as the span is used.
        /// </summary>
        /// <typeparam name="T">As in <see cref="ToArray{T}"/>.</typeparam>
        /// <param name="id">The id of the stream.</param>
        /// <returns>The span.</returns>
        /// <exception cref="PtLibException">There is no such stream, its elements have another
        /// size, or they do not lie one behind the other (then <see cref="ToArray{T}"/> copies
        /// them).</exception>
        public ReadOnlySpan<T> AsSpan<T>(string id)
            where T : unmanaged
        {
            using (Use())
            {
                var stream = Find(id, sizeof(T), out var elements);
                if (elements > 1 && (int)stream->Stride != sizeof(T))
                {
                    throw new PtLibException(
                        Status.Unsupported,
                        $"The elements of stream \"{id}\" do not lie one behind the other; use " +
                        "ToArray.",
                        nameof(id));
                }
                return new ReadOnlySpan<T>(stream->Data, checked((int)elements));
            }
        }
#endif

        /// <summary>The streams, and how many elements each has. The value is in use.</summary>
        internal abstract void Streams(
            out NativeStream** streams, out uint count, out uint elements);

        private static void Copy(NativeStream* stream, uint elements, byte* target)
        {
            var words = (int)stream->Components;
            var isConstant = (stream->Flags & 1) != 0;
            for (uint i = 0; i < elements; i++)
            {
                var offset = isConstant ? 0 : (ulong)i * (ulong)stream->Stride;
                var source = (uint*)((byte*)stream->Data + offset);
                var place = (uint*)target + ((long)i * words);
                for (var word = 0; word < words; word++)
                {
                    place[word] = source[word];
                }
            }
        }

        private NativeStream* Find(string id, int size, out uint elements)
        {
            NativeStream** streams;
            uint count;
            Streams(out streams, out count, out elements);
            for (uint i = 0; i < count; i++)
            {
                if (Utf8.Read(streams[i]->Id) != id)
                {
                    continue;
                }
                var needed = (int)streams[i]->Components * 4;
                if (size != needed)
                {
                    throw new PtLibException(
                        Status.TypeMismatch,
                        string.Format(
                            CultureInfo.InvariantCulture,
                            "The elements of stream \"{0}\" have {1} bytes, not {2}.",
                            id, needed, size),
                        nameof(id));
                }
                return streams[i];
            }
            throw new PtLibException(
                Status.NotFound, "There is no stream \"" + id + "\".", nameof(id));
        }
    }
}
