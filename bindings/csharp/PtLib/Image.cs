using System;
#if NET8_0_OR_GREATER
using System.Buffers;
#endif
using System.Runtime.InteropServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// A finished picture. It never changes, and any thread may read it. Dispose of it: its memory
    /// is that of the library (the garbage collector is told how much, but has its own time).
    /// </summary>
    public sealed unsafe class Image : IDisposable
    {
        private readonly ImageHandle handle;

        internal Image(IntPtr image)
        {
            var info = new NativeImageInfo { StructSize = (uint)sizeof(NativeImageInfo) };
            var status = NativeMethods.ptl_image_get_info(image, &info);
            handle = new ImageHandle(image, (long)info.SizeBytes);
            Errors.Check(status, IntPtr.Zero);
            Width = (int)info.Width;
            Height = (int)info.Height;
            Format = (PixelFormat)info.Format;
            Channels = (int)info.Channels;
            BytesPerChannel = (int)info.BytesPerChannel;
            RowStride = checked((int)info.RowStride);
            SizeBytes = (long)info.SizeBytes;
        }

        /// <summary>Width in pixels.</summary>
        public int Width { get; }

        /// <summary>Height in pixels.</summary>
        public int Height { get; }

        /// <summary>How the pixels are laid out; never <see cref="PixelFormat.Auto"/>.</summary>
        public PixelFormat Format { get; }

        /// <summary>1 (grey), 3 (red, green, blue) or 4 (and alpha).</summary>
        public int Channels { get; }

        /// <summary>1, 2 or 4.</summary>
        public int BytesPerChannel { get; }

        /// <summary>Bytes from one row to the next; rows have no gaps.</summary>
        public int RowStride { get; }

        /// <summary>Bytes of all pixels.</summary>
        public long SizeBytes { get; }

        /// <summary>
        /// Where the pixels are: 64-byte aligned, not to be changed, there until this is disposed
        /// of. Keep the image (GC.KeepAlive) as long as you use the pointer.
        /// </summary>
        public IntPtr PixelPointer
        {
            get
            {
                using (var image = handle.Use())
                {
                    var pixels = NativeMethods.ptl_image_pixels(image.Pointer, null);
                    if (pixels == null)
                    {
                        throw new OutOfMemoryException("There is no memory for the pixels.");
                    }
                    return (IntPtr)pixels;
                }
            }
        }

#if NET8_0_OR_GREATER
        /// <summary>
        /// The pixels in the memory of the library. The span must not be used after the image was
        /// disposed of, and the image has to be kept as long as the span is used;
        /// <see cref="Memory"/> does that by itself.
        /// </summary>
        public ReadOnlySpan<byte> Pixels
        {
            get { return new ReadOnlySpan<byte>((void*)PixelPointer, checked((int)SizeBytes)); }
        }

        /// <summary>
        /// The pixels as memory that may be stored and given to asynchronous methods. It keeps the
        /// image, and fails once that was disposed of.
        /// </summary>
        public ReadOnlyMemory<byte> Memory
        {
            get { return new PixelMemory(this).Memory; }
        }

        /// <summary>The pixels as numbers: byte, ushort or float as the format has them.</summary>
        /// <typeparam name="T">A type of the size of a channel.</typeparam>
        /// <returns>As <see cref="Pixels"/>.</returns>
        /// <exception cref="InvalidOperationException">The channels have another size.</exception>
        public ReadOnlySpan<T> PixelsAs<T>()
            where T : unmanaged
        {
            RequireChannel(sizeof(T));
            return MemoryMarshal.Cast<byte, T>(Pixels);
        }

        /// <summary>Copies the pixels in any format into a span.</summary>
        /// <typeparam name="T">A number: byte, ushort, float, or a struct of them.</typeparam>
        /// <param name="target">Where they go.</param>
        /// <param name="format">The format; Auto: that of the image.</param>
        /// <param name="order">Which row comes first.</param>
        /// <exception cref="PtLibException">The span is too small.</exception>
        public void CopyTo<T>(
            Span<T> target,
            PixelFormat format = PixelFormat.Auto,
            RowOrder order = RowOrder.TopDown)
            where T : unmanaged
        {
            fixed (T* memory = target)
            {
                CopyTo((IntPtr)memory, (long)target.Length * sizeof(T), format, 0, order);
            }
        }
#endif

        /// <summary>Copies the pixels in any format into an array.</summary>
        /// <typeparam name="T">A number: byte, ushort, float, or a struct of them.</typeparam>
        /// <param name="target">Where they go.</param>
        /// <param name="format">The format; Auto: that of the image.</param>
        /// <param name="order">Which row comes first.</param>
        /// <exception cref="PtLibException">The array is too small.</exception>
        public void CopyTo<T>(
            T[] target,
            PixelFormat format = PixelFormat.Auto,
            RowOrder order = RowOrder.TopDown)
            where T : struct
        {
            using (var pinned = new Pinned<T>(target, nameof(target)))
            {
                CopyTo(pinned.Address, pinned.Bytes, format, 0, order);
            }
        }

        /// <summary>
        /// Copies the pixels in any format to memory. A colour becomes grey by its mean, a missing
        /// alpha is 1.
        /// </summary>
        /// <param name="target">Where they go.</param>
        /// <param name="size">Its size in bytes.</param>
        /// <param name="format">The format; Auto: that of the image.</param>
        /// <param name="rowStride">Bytes from one row to the next; 0: rows without gaps.</param>
        /// <param name="order">Which row comes first.</param>
        /// <exception cref="PtLibException">The memory is too small.</exception>
        public void CopyTo(
            IntPtr target,
            long size,
            PixelFormat format = PixelFormat.Auto,
            int rowStride = 0,
            RowOrder order = RowOrder.TopDown)
        {
            IntPtr error;
            using (var image = handle.Use())
            {
                var status = NativeMethods.ptl_image_copy(
                    image.Pointer,
                    (uint)format,
                    (void*)target,
                    (UIntPtr)Number.Unsigned(size, nameof(size)),
                    (UIntPtr)Number.Unsigned(rowStride, nameof(rowStride)),
                    &error);
                Errors.Check(status, error);
            }
            if (order == RowOrder.BottomUp)
            {
                var row = Width * PixelBytes(format == PixelFormat.Auto ? Format : format);
                Flip((byte*)target, row, rowStride == 0 ? row : rowStride);
            }
        }

        /// <summary>The pixels in the format of the image, rows without gaps.</summary>
        /// <returns>A new array.</returns>
        public byte[] ToArray()
        {
            var bytes = new byte[SizeBytes];
            CopyTo(bytes);
            return bytes;
        }

        /// <summary>The pixels as floats, as many channels as the image has.</summary>
        /// <returns>A new array of <see cref="Width"/> × <see cref="Height"/> ×
        /// <see cref="Channels"/> numbers.</returns>
        public float[] ToFloatArray()
        {
            var numbers = new float[(long)Width * Height * Channels];
            const int ofFloats = (int)PixelFormat.GreyFloat & ~0xFF;
            CopyTo(numbers, (PixelFormat)(ofFloats | Channels));
            return numbers;
        }

        /// <summary>
        /// Saves the image as a picture; the ending of the path tells the format: ".png" always,
        /// others if <see cref="PtLibrary.HasFeature"/> says "formats". An existing file is
        /// overwritten.
        /// </summary>
        /// <param name="path">The path.</param>
        public void Save(string path)
        {
            IntPtr error;
            using (var image = handle.Use())
            fixed (byte* text = Utf8.Of(path, nameof(path)))
            {
                var status = NativeMethods.ptl_image_save(image.Pointer, text, &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>Gives up the image and its pixels.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }

        internal Lease Use()
        {
            return handle.Use();
        }

        private static int PixelBytes(PixelFormat format)
        {
            return ((int)format & 0xFF) * (((int)format >> 8) & 0xFF);
        }

        private void Flip(byte* pixels, int row, int stride)
        {
            for (var y = 0; y < Height / 2; y++)
            {
                var upper = pixels + ((long)y * stride);
                var lower = pixels + ((long)(Height - 1 - y) * stride);
                for (var i = 0; i < row; i++)
                {
                    var kept = upper[i];
                    upper[i] = lower[i];
                    lower[i] = kept;
                }
            }
        }

#if NET8_0_OR_GREATER
        private void RequireChannel(int size)
        {
            if (size != BytesPerChannel)
            {
                throw new InvalidOperationException(
                    $"The channels of the image have {BytesPerChannel} bytes, not {size}.");
            }
        }

        private sealed class PixelMemory : MemoryManager<byte>
        {
            private readonly Image image;

            internal PixelMemory(Image image)
            {
                this.image = image;
            }

            public override Memory<byte> Memory
            {
                get { return CreateMemory(checked((int)image.SizeBytes)); }
            }

            public override Span<byte> GetSpan()
            {
                return new Span<byte>((void*)image.PixelPointer, checked((int)image.SizeBytes));
            }

            public override MemoryHandle Pin(int elementIndex = 0)
            {
                var kept = GCHandle.Alloc(image);
                return new MemoryHandle((byte*)image.PixelPointer + elementIndex, kept, this);
            }

            public override void Unpin()
            {
                // The handle that Pin gave frees what it keeps.
            }

            protected override void Dispose(bool disposing)
            {
                // The image belongs to its owner.
            }
        }
#endif
    }
}
