namespace PtLib
{
    /// <summary>What values are computed in.</summary>
    public enum Precision
    {
        /// <summary>That of the graph: in compute options.</summary>
        Default = 0,

        /// <summary>Values are multiples of 1/255, as PT Designer computes.</summary>
        EightBit = 1,

        /// <summary>Values are 32-bit floating-point numbers.</summary>
        Float = 2,
    }
}
