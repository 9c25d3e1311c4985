namespace PtLib.Blocks
{
    /// <summary>
    /// A block that makes the whole image in one call from whole inputs: simulations, and all that
    /// is not made row by row.
    /// </summary>
    /// <typeparam name="TState">What is prepared once for a computation, such as the values of
    /// parameters.</typeparam>
    public abstract class ImageBlock<TState> : ManagedBlock
        where TState : class
    {
        /// <summary>Names the block type.</summary>
        /// <param name="id">Its id: "vendor.name".</param>
        /// <param name="documentation">What it makes, in one sentence.</param>
        protected ImageBlock(string id, string documentation)
            : base(id, documentation)
        {
        }

        internal override uint Shape
        {
            get { return 3; }
        }

        /// <summary>Prepares a computation.</summary>
        /// <param name="setup">Size, seed, and the values of parameters.</param>
        /// <returns>What <see cref="Compute"/> needs.</returns>
        protected abstract TState Prepare(BlockSetup setup);

        /// <summary>Writes the image.</summary>
        /// <param name="state">What was prepared.</param>
        /// <param name="call">The images.</param>
        protected abstract void Compute(TState state, BlockCall call);

        internal override object PrepareState(BlockSetup setup)
        {
            return Prepare(setup);
        }

        internal override void ComputeWith(object state, BlockCall call)
        {
            Compute((TState)state, call);
        }
    }
}
