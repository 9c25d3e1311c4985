namespace PtLib.Blocks
{
    /// <summary>
    /// A block that makes each row from the same row of its inputs, and from the position: noise,
    /// patterns, changes of colour. It is fused with its neighbours.
    /// </summary>
    /// <typeparam name="TState">What is prepared once for a computation, such as the values of
    /// parameters. Several threads read it at once.</typeparam>
    public abstract class RowBlock<TState> : ManagedBlock
        where TState : class
    {
        /// <summary>Names the block type.</summary>
        /// <param name="id">Its id: "vendor.name".</param>
        /// <param name="documentation">What it makes, in one sentence.</param>
        protected RowBlock(string id, string documentation)
            : base(id, documentation)
        {
        }

        internal override uint Shape
        {
            get { return 1; }
        }

        /// <summary>Prepares a computation.</summary>
        /// <param name="setup">Size, seed, and the values of parameters.</param>
        /// <returns>What <see cref="Row"/> needs.</returns>
        protected abstract TState Prepare(BlockSetup setup);

        /// <summary>Writes one row, or a part of it.</summary>
        /// <param name="state">What was prepared.</param>
        /// <param name="call">The images: parts of the same width and height.</param>
        /// <param name="row">The row in these parts. In the whole image it is the row
        /// call.Output.Y + row, and its first column is call.Output.X.</param>
        protected abstract void Row(TState state, BlockCall call, int row);

        internal override object PrepareState(BlockSetup setup)
        {
            return Prepare(setup);
        }

        internal override void ComputeWith(object state, BlockCall call)
        {
            var height = call.Output.Height;
            for (var row = 0; row < height; row++)
            {
                Row((TState)state, call, row);
            }
        }
    }
}
