using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>Descriptions of streams over an array of structs, for one call.</summary>
    internal sealed unsafe class StreamList : IDisposable
    {
        private readonly List<IntPtr> memory = new List<IntPtr>();

        internal StreamList(
            VertexStream[] streams, IntPtr data, int stride, bool isEmpty, string name)
        {
            try
            {
                Fill(streams, data, stride, isEmpty, name);
            }
            catch
            {
                Dispose();
                throw;
            }
        }

        internal NativeStream** Pointer { get; private set; }

        internal uint Count { get; private set; }

        public void Dispose()
        {
            foreach (var block in memory)
            {
                Marshal.FreeHGlobal(block);
            }
            memory.Clear();
        }

        private void Fill(
            VertexStream[] streams, IntPtr data, int stride, bool isEmpty, string name)
        {
            Require(streams, name);
            var list = Allocate(Math.Max(1, streams.Length) * sizeof(NativeStream*));
            Pointer = (NativeStream**)list;
            Count = (uint)streams.Length;
            for (var i = 0; i < streams.Length; i++)
            {
                var stream = streams[i];
                Check(stream, stride, i, name);
                var id = Utf8.Of(stream.Id, name);
                var text = Allocate(id.Length);
                Marshal.Copy(id, 0, text, id.Length);
                var native = (NativeStream*)Allocate(sizeof(NativeStream));
                *native = new NativeStream
                {
                    StructSize = (uint)sizeof(NativeStream),
                    Type = stream.IsFloat ? 1u : 2u,
                    Components = (uint)stream.Components,
                    Id = (byte*)text,
                    Data = isEmpty ? null : (byte*)data + stream.Offset,
                    Stride = (UIntPtr)(uint)stride,
                };
                Pointer[i] = native;
            }
        }

        private static void Require(VertexStream[] streams, string name)
        {
            if (streams == null)
            {
                throw new PtLibException(
                    Status.InvalidArgument, name + " is null, an array is needed.", name);
            }
        }

        // The library cannot know where the struct ends: reading behind it is stopped here.
        private static void Check(VertexStream stream, int stride, int index, string name)
        {
            if (stream == null || stream.Id == null)
            {
                throw new PtLibException(
                    Status.InvalidArgument, name + "[" + index + "] is null.", name);
            }
            var end = (long)stream.Offset + ((long)stream.Components * 4);
            if (stream.Components < 1 || stream.Components > 4 || stream.Offset < 0 ||
                stream.Offset % 4 != 0 || end > stride)
            {
                throw new PtLibException(
                    Status.OutOfRange,
                    name + "[" + index + "] (" + stream.Id + "): " + stream.Components +
                    " numbers at offset " + stream.Offset + ", allowed are 1 to 4 numbers of 4 " +
                    "bytes at a multiple of 4 inside of the struct, which has " + stride +
                    " bytes.",
                    name);
            }
        }

        private IntPtr Allocate(int size)
        {
            var block = Marshal.AllocHGlobal(size);
            memory.Add(block);
            return block;
        }
    }
}
