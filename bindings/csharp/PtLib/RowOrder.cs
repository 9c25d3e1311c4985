namespace PtLib
{
    /// <summary>Which row of an image comes first in memory.</summary>
    public enum RowOrder
    {
        /// <summary>The top one, as everywhere in ptlib.</summary>
        TopDown = 0,

        /// <summary>The bottom one, as textures of OpenGL and Unity have it.</summary>
        BottomUp = 1,
    }
}
