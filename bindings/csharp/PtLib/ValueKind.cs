namespace PtLib
{
    /// <summary>What flows on a wire.</summary>
    public enum ValueKind
    {
        /// <summary>No value: an input that is not connected.</summary>
        None = 0,

        /// <summary>An image.</summary>
        Image = 1,

        /// <summary>A colour transition.</summary>
        Gradient = 2,

        /// <summary>A text of any meaning, such as the string of an L-system.</summary>
        Text = 3,

        /// <summary>Points, each perhaps with more data.</summary>
        Points = 4,

        /// <summary>Triangles.</summary>
        Mesh = 5,

        /// <summary>Polylines, such as hairs.</summary>
        Strands = 6,

        /// <summary>Reserved.</summary>
        Volume = 7,
    }
}
