using System.Runtime.InteropServices;

namespace PtLib
{
    /// <summary>A point in the plane.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Point2
    {
        /// <summary>From left to right.</summary>
        public float X;

        /// <summary>From top to bottom.</summary>
        public float Y;

        /// <summary>Makes a point.</summary>
        /// <param name="x">From left to right.</param>
        /// <param name="y">From top to bottom.</param>
        public Point2(float x, float y)
        {
            X = x;
            Y = y;
        }
    }
}
