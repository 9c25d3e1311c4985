using System;

namespace PtLib.Blocks
{
    /// <summary>A part of an image, in the memory of the engine. There only during the call.
    /// </summary>
    public readonly unsafe ref struct BlockImage
    {
        private readonly NativeTile* tile;
        private readonly bool isWritable;

        internal BlockImage(NativeTile* tile, bool isWritable)
        {
            this.tile = tile;
            this.isWritable = isWritable;
        }

        /// <summary>Whether there is one: an optional input may not be connected.</summary>
        public bool IsPresent
        {
            get { return tile != null; }
        }

        /// <summary>Column of its left edge in the whole image.</summary>
        public int X
        {
            get { return (int)Present()->X; }
        }

        /// <summary>Row of its upper edge in the whole image.</summary>
        public int Y
        {
            get { return (int)Present()->Y; }
        }

        /// <summary>Its width.</summary>
        public int Width
        {
            get { return (int)Present()->Width; }
        }

        /// <summary>Its height.</summary>
        public int Height
        {
            get { return (int)Present()->Height; }
        }

        /// <summary>The width of the whole image.</summary>
        public int ImageWidth
        {
            get { return (int)Present()->ImageWidth; }
        }

        /// <summary>The height of the whole image.</summary>
        public int ImageHeight
        {
            get { return (int)Present()->ImageHeight; }
        }

        /// <summary>Its channels: 1 (grey), 3 (red, green, blue) or 4 (and alpha). A grey image
        /// can be read as red, green and blue as well.</summary>
        public int Channels
        {
            get { return (int)Present()->Channels; }
        }

        /// <summary>A row of a channel.</summary>
        /// <param name="channel">0 red or grey, 1 green, 2 blue, 3 alpha.</param>
        /// <param name="row">The row, from 0 at the upper edge of this part.</param>
        /// <returns>Its samples.</returns>
        public Samples Row(int channel, int row)
        {
            var plane = Plane(channel);
            if (plane == null || (uint)row >= Present()->Height)
            {
                throw new ArgumentOutOfRangeException(
                    plane == null ? nameof(channel) : nameof(row));
            }
            var first = plane + ((long)row * (long)tile->RowStride);
            return new Samples(first, (int)tile->Width, isWritable);
        }

        private float* Plane(int channel)
        {
            switch (channel)
            {
                case 0:
                    return Present()->Red;
                case 1:
                    return Present()->Green;
                case 2:
                    return Present()->Blue;
                case 3:
                    return Present()->Alpha;
                default:
                    return null;
            }
        }

        private NativeTile* Present()
        {
            if (tile == null)
            {
                throw new InvalidOperationException("The input is not connected.");
            }
            return tile;
        }
    }
}
