using System;

namespace PtLib
{
    /// <summary>What holds for the blocks of a type.</summary>
    [Flags]
    public enum BlockTypeFlags
    {
        /// <summary>None of them.</summary>
        None = 0,

        /// <summary>Its output is a result of the graph.</summary>
        IsResult = 1,

        /// <summary>It writes a file.</summary>
        WritesFile = 2,

        /// <summary>Another seed gives another picture.</summary>
        UsesSeed = 4,

        /// <summary>Its output always tiles when its inputs do.</summary>
        Tiles = 8,

        /// <summary>Its value is set by <see cref="Graph.SetInput(Block, Value)"/>.</summary>
        IsInput = 16,
    }
}
