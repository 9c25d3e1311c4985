using System;

namespace PtLib.Blocks
{
    /// <summary>Samples of one channel in one row, in the memory of the engine: 0 is black, 1 is
    /// white. There only during the call.</summary>
    public readonly unsafe ref struct Samples
    {
        private readonly float* first;

        internal Samples(float* first, int length)
        {
            this.first = first;
            Length = length;
        }

        /// <summary>How many there are.</summary>
        public int Length { get; }

        /// <summary>One sample. Those of inputs are only to be read.</summary>
        /// <param name="index">Its number, from 0.</param>
        /// <returns>The sample.</returns>
        public float this[int index]
        {
            get
            {
                return first[Checked(index)];
            }

            set
            {
                first[Checked(index)] = value;
            }
        }

#if NET8_0_OR_GREATER
        /// <summary>All of them.</summary>
        /// <returns>A span over the memory of the engine.</returns>
        public Span<float> AsSpan()
        {
            return new Span<float>(first, Length);
        }
#endif

        private int Checked(int index)
        {
            if ((uint)index >= (uint)Length)
            {
                throw new IndexOutOfRangeException();
            }
            return index;
        }
    }
}
