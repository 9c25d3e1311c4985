namespace PtLib
{
    /// <summary>Where an input gets its value from.</summary>
    public readonly struct Connection
    {
        internal Connection(Block block, int output)
        {
            Block = block;
            Output = output;
        }

        /// <summary>The block whose output it is.</summary>
        public Block Block { get; }

        /// <summary>The number of the output, from 0.</summary>
        public int Output { get; }
    }
}
