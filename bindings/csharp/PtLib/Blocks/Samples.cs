using System;

namespace PtLib.Blocks
{
    /// <summary>Samples of one channel in one row, in the memory of the engine: 0 is black, 1 is
    /// white. There only during the call.</summary>
    public readonly unsafe ref struct Samples
    {
        private readonly float* first;

        internal Samples(float* first, int length, bool isWritable)
        {
            this.first = first;
            IsWritable = isWritable;
            Length = length;
        }

        /// <summary>How many there are.</summary>
        public int Length { get; }

        /// <summary>Whether they are those of an output; those of inputs are only read.</summary>
        public bool IsWritable { get; }

        /// <summary>One sample.</summary>
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
                RequireWritable();
                first[Checked(index)] = value;
            }
        }

#if NET8_0_OR_GREATER
        /// <summary>All of an output, to be written.</summary>
        /// <returns>A span over the memory of the engine.</returns>
        /// <exception cref="InvalidOperationException">They are those of an input.</exception>
        public Span<float> AsSpan()
        {
            RequireWritable();
            return new Span<float>(first, Length);
        }

        /// <summary>All of them, to be read.</summary>
        /// <returns>A span over the memory of the engine.</returns>
        public ReadOnlySpan<float> AsReadOnlySpan()
        {
            return new ReadOnlySpan<float>(first, Length);
        }
#endif

        private void RequireWritable()
        {
            if (!IsWritable)
            {
                throw new InvalidOperationException("The samples of an input are only read.");
            }
        }

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
