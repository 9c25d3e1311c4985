using System.Runtime.InteropServices;

namespace PtLib
{
    /// <summary>A point, a direction or a normal in space.</summary>
    [StructLayout(LayoutKind.Sequential)]
    public struct Point3
    {
        /// <summary>The first coordinate.</summary>
        public float X;

        /// <summary>The second coordinate.</summary>
        public float Y;

        /// <summary>The third coordinate.</summary>
        public float Z;

        /// <summary>Makes a point.</summary>
        /// <param name="x">The first coordinate.</param>
        /// <param name="y">The second coordinate.</param>
        /// <param name="z">The third coordinate.</param>
        public Point3(float x, float y, float z)
        {
            X = x;
            Y = y;
            Z = z;
        }
    }
}
