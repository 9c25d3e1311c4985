using System;

namespace PtLib.Aging
{
    /// <summary>What <see cref="AgingSim.Run"/> computes. The rest costs nothing.</summary>
    [Flags]
    public enum AgingOutputs
    {
        /// <summary>Nothing.</summary>
        None = 0,

        /// <summary>The heights of wrinkles, as a texture.</summary>
        Height = 1,

        /// <summary>Normals of wrinkles and of fine ones, with the heights as alpha.</summary>
        Normals = 2,

        /// <summary>The age at which hair is lost at each place of the texture.</summary>
        LossAge = 4,

        /// <summary>A picture of the head.</summary>
        View = 8,

        /// <summary>The strands of hair that are left, and how many at any age.</summary>
        Hair = 16,

        /// <summary>All of it.</summary>
        All = Height | Normals | LossAge | View | Hair,
    }
}
