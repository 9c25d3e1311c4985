using System;
using System.Runtime.InteropServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// Rows of a result that are done: see <see cref="Graph.ComputeBands"/>. It can be read during
    /// the call that gets it.
    /// </summary>
    public sealed unsafe class Band
    {
        private IntPtr pixels;

        internal Band(NativeBand native)
        {
            FirstRow = checked((int)native.FirstRow);
            Rows = checked((int)native.Rows);
            Width = checked((int)native.Width);
            Format = (PixelFormat)native.Format;
            RowStride = checked((int)(uint)native.RowStride);
            pixels = (IntPtr)native.Pixels;
        }

        /// <summary>The number of the first row in the result, from the top.</summary>
        public int FirstRow { get; }

        /// <summary>How many rows there are.</summary>
        public int Rows { get; }

        /// <summary>Pixels of a row.</summary>
        public int Width { get; }

        /// <summary>The format of a pixel.</summary>
        public PixelFormat Format { get; }

        /// <summary>Bytes from one row to the next; rows lie without gaps.</summary>
        public int RowStride { get; }

        /// <summary>Copies the pixels.</summary>
        /// <returns><see cref="Rows"/> times <see cref="RowStride"/> bytes.</returns>
        /// <exception cref="ObjectDisposedException">The call is over.</exception>
        public byte[] ToArray()
        {
            var bytes = new byte[(long)Rows * RowStride];
            Marshal.Copy(Address(), bytes, 0, bytes.Length);
            return bytes;
        }

#if NET8_0_OR_GREATER
        /// <summary>The pixels, in the memory of the library.</summary>
        /// <exception cref="ObjectDisposedException">The call is over.</exception>
        public ReadOnlySpan<byte> Pixels
        {
            get { return new ReadOnlySpan<byte>((void*)Address(), checked(Rows * RowStride)); }
        }
#endif

        internal void End()
        {
            pixels = IntPtr.Zero;
        }

        private IntPtr Address()
        {
            return pixels != IntPtr.Zero ? pixels : throw new ObjectDisposedException(nameof(Band));
        }
    }
}
