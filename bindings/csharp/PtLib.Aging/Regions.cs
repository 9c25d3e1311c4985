using System;

namespace PtLib.Aging
{
    /// <summary>
    /// Where hair grows unless the caller says it: on a head whose texture coordinates are those of
    /// a sphere around it. The face is in the middle of the texture, the back at its left and right
    /// border, the crown at its top.
    /// </summary>
    internal static class Regions
    {
        private const int Side = 256;

        // Heights in the texture, from the bottom: of the hair line over the face and at the nape,
        // and of the upper rim of what old age leaves.
        private const double Forehead = 0.70;
        private const double Nape = 0.40;
        private const double Rim = 0.64;

        // Parts of the way from the face, 0, to the back of the head, 1.
        private const double Temple = 0.22;
        private const double Ear = 0.56;
        private const double Left = 0.42;

        internal static ImageSource Outer()
        {
            return Draw((around, up) => up >= Line(around));
        }

        internal static ImageSource Inner()
        {
            return Draw((around, up) => around >= Left && up >= Line(around) && up <= Rim);
        }

        /// <summary>The lower end of the hair.</summary>
        private static double Line(double around)
        {
            var way = Math.Min(Math.Max((around - Temple) / (Ear - Temple), 0), 1);
            return Forehead + ((Nape - Forehead) * way * way * (3 - (2 * way)));
        }

        private static ImageSource Draw(Func<double, double, bool> isInside)
        {
            var pixels = new float[Side * Side];
            for (var i = 0; i < pixels.Length; i++)
            {
                var across = ((i % Side) + 0.5) / Side;
                var up = 1 - (((i / Side) + 0.5) / Side);
                pixels[i] = isInside(Math.Abs((2 * across) - 1), up) ? 1 : 0;
            }
            return ImageSource.FromPixels(pixels, Side, Side);
        }
    }
}
