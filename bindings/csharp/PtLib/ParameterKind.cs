namespace PtLib
{
    /// <summary>What a parameter holds.</summary>
    public enum ParameterKind
    {
        /// <summary>A whole number.</summary>
        Integer = 1,

        /// <summary>A number.</summary>
        Number = 2,

        /// <summary>Yes (1) or no (0).</summary>
        Flag = 3,

        /// <summary>One of several alternatives: by number, or by id as a text.</summary>
        Choice = 4,

        /// <summary>A text.</summary>
        Text = 5,

        /// <summary>The path of a file.</summary>
        Path = 6,
    }
}
