using System;
using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// How a computation differs from what the graph and the engine say. What is 0 or null means:
    /// as they say.
    /// </summary>
    public sealed class ComputeOptions
    {
        internal static readonly ComputeOptions Default = new ComputeOptions();

        private const uint HasSeed = 1;
        private const uint KeepsGoing = 2;

        /// <summary>Width of the result in pixels; give both or neither.</summary>
        public int Width { get; set; }

        /// <summary>Height of the result in pixels.</summary>
        public int Height { get; set; }

        /// <summary>How the pixels are laid out.</summary>
        public PixelFormat Format { get; set; }

        /// <summary>The most threads, the caller's included.</summary>
        public int Threads { get; set; }

        /// <summary>The seed of blocks without their own.</summary>
        public ulong? Seed { get; set; }

        /// <summary>The most bytes to take at the peak.</summary>
        public long MemoryLimit { get; set; }

        /// <summary>Each pixel is the mean of this many times this many, 1 to 6.</summary>
        public int Supersampling { get; set; }

        /// <summary>What values are computed in.</summary>
        public Precision Precision { get; set; }

        /// <summary>Where a block fails, go on with a white image in its place.</summary>
        public bool KeepGoing { get; set; }

        /// <summary>The least time between two reports of progress; 0 for 50 ms.</summary>
        public TimeSpan ProgressInterval { get; set; }

        internal unsafe NativeComputeOptions ToNative()
        {
            var milliseconds = ProgressInterval.TotalMilliseconds;
            if (!(milliseconds >= 0 && milliseconds <= uint.MaxValue))
            {
                throw new ArgumentOutOfRangeException(nameof(ProgressInterval));
            }
            return new NativeComputeOptions
            {
                StructSize = (uint)sizeof(NativeComputeOptions),
                Flags = (Seed.HasValue ? HasSeed : 0) | (KeepGoing ? KeepsGoing : 0),
                Width = Number.Unsigned(Width, nameof(Width)),
                Height = Number.Unsigned(Height, nameof(Height)),
                Format = (uint)Format,
                Threads = Number.Unsigned(Threads, nameof(Threads)),
                Seed = Seed.GetValueOrDefault(),
                MemoryLimit = Number.Unsigned(MemoryLimit, nameof(MemoryLimit)),
                Supersampling = Number.Unsigned(Supersampling, nameof(Supersampling)),
                Precision = (uint)Precision,
                ProgressIntervalMs = (uint)Math.Ceiling(milliseconds),
            };
        }
    }
}
