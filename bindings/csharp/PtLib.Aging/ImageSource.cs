using System;
using System.Diagnostics.CodeAnalysis;
using System.IO;

namespace PtLib.Aging
{
    /// <summary>
    /// A picture that is given: the name of a file, an <see cref="Image"/>, or numbers. Each
    /// becomes one where it is needed. Whatever its size, it is stretched to that of the textures.
    /// </summary>
    public sealed class ImageSource
    {
        [AllowNull]
        [MaybeNull]
        private readonly Image image;

        [AllowNull]
        [MaybeNull]
        private readonly float[] pixels;

        private readonly int width;
        private readonly int height;

        private ImageSource(
            [AllowNull] string file, [AllowNull] Image image, [AllowNull] float[] pixels,
            int width, int height)
        {
            File = file;
            this.image = image;
            this.pixels = pixels;
            this.width = width;
            this.height = height;
        }

        /// <summary>The whole path of the file; null if it is none.</summary>
        [AllowNull]
        [MaybeNull]
        public string File { get; }

        /// <summary>A picture file.</summary>
        /// <param name="path">Its path; null for no picture.</param>
        [return: MaybeNull]
        public static implicit operator ImageSource([AllowNull] string path)
        {
            return path == null ? default(ImageSource) : FromFile(path);
        }

        /// <summary>An image.</summary>
        /// <param name="image">The image; null for no picture.</param>
        [return: MaybeNull]
        public static implicit operator ImageSource([AllowNull] Image image)
        {
            return image == null ? default(ImageSource) : FromImage(image);
        }

        /// <summary>A square of grey pixels.</summary>
        /// <param name="pixels">The pixels, rows from the top; null for no picture.</param>
        [return: MaybeNull]
        public static implicit operator ImageSource([AllowNull] float[] pixels)
        {
            if (pixels == null)
            {
                return default(ImageSource);
            }
            var side = (int)Math.Round(Math.Sqrt(pixels.Length));
            if (side == 0 || (long)side * side != pixels.Length)
            {
                throw new PtLibException(
                    Status.InvalidArgument,
                    pixels.Length + " numbers are no square; say width and height with " +
                    "ImageSource.FromPixels.",
                    nameof(pixels));
            }
            return FromPixels(pixels, side, side);
        }

        /// <summary>A picture file. It is read when it is needed. A graph that uses files may read
        /// below the deepest folder that all of them are in.</summary>
        /// <param name="path">Its path.</param>
        /// <returns>The picture.</returns>
        public static ImageSource FromFile(string path)
        {
            if (string.IsNullOrEmpty(path))
            {
                throw new PtLibException(
                    Status.InvalidArgument, "The path of a picture is empty.", nameof(path));
            }
            return new ImageSource(Path.GetFullPath(path), null, null, 0, 0);
        }

        /// <summary>An image. It must not be disposed of while this is used.</summary>
        /// <param name="image">The image.</param>
        /// <returns>The picture.</returns>
        public static ImageSource FromImage(Image image)
        {
            if (image == null)
            {
                throw new ArgumentNullException(nameof(image));
            }
            return new ImageSource(null, image, null, image.Width, image.Height);
        }

        /// <summary>Numbers: 1 for each pixel (grey), 3 (red, green, blue) or 4 (and alpha). The
        /// array is kept, and read when it is needed.</summary>
        /// <param name="pixels">The numbers, rows from the top without gaps.</param>
        /// <param name="width">Width in pixels.</param>
        /// <param name="height">Height in pixels.</param>
        /// <returns>The picture.</returns>
        /// <exception cref="PtLibException">The array is null or of the wrong length.</exception>
        public static ImageSource FromPixels(float[] pixels, int width, int height)
        {
            var count = pixels == null ? 0L : pixels.Length;
            var area = width > 0 && height > 0 ? (long)width * height : 0L;
            if (pixels == null || area == 0 ||
                (count != area && count != 3 * area && count != 4 * area))
            {
                throw new PtLibException(
                    Status.InvalidArgument,
                    "pixels has " + count + " numbers, " + width + " × " + height +
                    " pixels need 1, 3 or 4 each.",
                    nameof(pixels));
            }
            return new ImageSource(null, null, pixels, width, height);
        }

        /// <summary>The picture as a value, unless it is a file.</summary>
        internal ImageValue ToValue()
        {
            var numbers = image != null ? image.ToFloatArray() : pixels ?? new float[0];
            return ImageValue.FromPixels(
                numbers, width, height, FormatOf(numbers.Length / ((long)width * height)));
        }

        private static PixelFormat FormatOf(long channels)
        {
            return channels == 1 ? PixelFormat.GreyFloat
                : channels == 3 ? PixelFormat.RgbFloat : PixelFormat.RgbaFloat;
        }
    }
}
