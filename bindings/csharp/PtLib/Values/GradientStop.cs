using System.Runtime.InteropServices;

namespace PtLib
{
    /// <summary>A colour at a position of a colour transition.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct GradientStop
    {
        /// <summary>Where, 0 to 1.</summary>
        public float Position;

        /// <summary>Red, 0 to 1.</summary>
        public float Red;

        /// <summary>Green, 0 to 1.</summary>
        public float Green;

        /// <summary>Blue, 0 to 1.</summary>
        public float Blue;

        /// <summary>Makes a colour at a position.</summary>
        /// <param name="position">Where, 0 to 1.</param>
        /// <param name="red">Red, 0 to 1.</param>
        /// <param name="green">Green, 0 to 1.</param>
        /// <param name="blue">Blue, 0 to 1.</param>
        public GradientStop(float position, float red, float green, float blue)
        {
            Position = position;
            Red = red;
            Green = green;
            Blue = blue;
        }
    }
}
