using System;

namespace PtLib.Blocks
{
    /// <summary>A block written in C# in one computation.</summary>
    internal sealed class BlockInstance
    {
        internal BlockInstance(ManagedBlock block)
        {
            Block = block;
        }

        internal ManagedBlock Block { get; }

        internal object State { get; set; } = string.Empty;
    }
}
