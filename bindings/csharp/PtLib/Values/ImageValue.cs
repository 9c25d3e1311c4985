using System;
using System.Runtime.CompilerServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>An image as a value: for the inputs of a graph.</summary>
    public sealed unsafe class ImageValue : Value
    {
        internal ImageValue(IntPtr value)
            : base(value, 0)
        {
        }

        /// <summary>Makes an image of pixels, which are converted during the call.</summary>
        /// <typeparam name="T">A number: byte, ushort, float, or a struct of them.</typeparam>
        /// <param name="pixels">The pixels, rows from the top without gaps.</param>
        /// <param name="width">Width in pixels.</param>
        /// <param name="height">Height in pixels.</param>
        /// <param name="format">The format; not Auto.</param>
        /// <returns>The image; dispose of it.</returns>
        /// <exception cref="PtLibException">The array is null or of the wrong length, or a number
        /// is not finite: the message names the first one.</exception>
        public static ImageValue FromPixels<T>(
            T[] pixels, int width, int height, PixelFormat format)
            where T : struct
        {
            Loader.Ensure();
            return Make(pixels, width, height, format);
        }

        /// <summary>The image in a format.</summary>
        /// <param name="format">The format; Auto: floats, as many channels as it has.</param>
        /// <returns>The image; dispose of it. It does not need the value any more.</returns>
        public Image ToImage(PixelFormat format = PixelFormat.Auto)
        {
            IntPtr image, error;
            using (var value = Use())
            {
                var status = NativeMethods.ptl_value_image(
                    value.Pointer, (uint)format, &image, &error);
                Errors.Check(status, error);
            }
            return new Image(image);
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static ImageValue Make<T>(T[] pixels, int width, int height, PixelFormat format)
            where T : struct
        {
            using (var pinned = new Pinned<T>(pixels, nameof(pixels)))
            {
                var pixelBytes = ((long)format & 0xFF) * (((long)format >> 8) & 0xFF);
                var needed = Number.Unsigned(width, nameof(width)) *
                    (decimal)Number.Unsigned(height, nameof(height)) * pixelBytes;
                if (pinned.Bytes != needed)
                {
                    throw new PtLibException(
                        Status.InvalidArgument,
                        "pixels has " + pinned.Bytes + " bytes, " + width + " × " + height +
                        " pixels of format " + format + " need " + needed + ".",
                        nameof(pixels));
                }
                var data = new NativeImageData
                {
                    StructSize = (uint)sizeof(NativeImageData),
                    Format = (uint)format,
                    Width = (uint)width,
                    Height = (uint)height,
                    Pixels = (void*)pinned.Address,
                };
                IntPtr value, error;
                var status = NativeMethods.ptl_value_from_image(
                    &data, 0, IntPtr.Zero, null, &value, &error);
                Errors.Check(status, error);
                return new ImageValue(value);
            }
        }
    }
}
