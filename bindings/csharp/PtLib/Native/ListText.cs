using System.Globalization;
using System.Text;

namespace PtLib.Native
{
    /// <summary>Arrays as the texts that some parameters hold.</summary>
    internal static class ListText
    {
        /// <summary>Points as x:y,x:y,…</summary>
        internal static string Of(Point2[] points, string name)
        {
            Require(points, name);
            var text = new StringBuilder();
            for (var i = 0; i < points.Length; i++)
            {
                Check(points[i].X, name, i, "X");
                Check(points[i].Y, name, i, "Y");
                text.Append(i == 0 ? string.Empty : ",");
                text.Append(Decimal(points[i].X)).Append(':').Append(Decimal(points[i].Y));
            }
            return text.ToString();
        }

        /// <summary>Stops as position red green blue;… in 0 to 255.</summary>
        internal static string Of(GradientStop[] stops, string name)
        {
            Require(stops, name);
            var text = new StringBuilder();
            for (var i = 0; i < stops.Length; i++)
            {
                text.Append(Level(stops[i].Position, name, i, "Position")).Append(' ');
                text.Append(Level(stops[i].Red, name, i, "Red")).Append(' ');
                text.Append(Level(stops[i].Green, name, i, "Green")).Append(' ');
                text.Append(Level(stops[i].Blue, name, i, "Blue")).Append(';');
            }
            return text.ToString();
        }

        private static string Level(float number, string name, int index, string field)
        {
            Check(number, name, index, field);
            return ((int)((number * 255) + 0.5f)).ToString(CultureInfo.InvariantCulture);
        }

        /// <summary>A number of 0 to 1 with all digits of a float, never with an exponent.
        /// </summary>
        private static string Decimal(float number)
        {
            return ((double)number).ToString("0.#########", CultureInfo.InvariantCulture);
        }

        private static void Require(object array, string name)
        {
            if (array == null)
            {
                throw new PtLibException(
                    Status.InvalidArgument, name + " is null, an array is needed.", name);
            }
        }

        private static void Check(float number, string name, int index, string field)
        {
            if (!(number >= 0 && number <= 1))
            {
                var shown = number.ToString(CultureInfo.InvariantCulture);
                throw new PtLibException(
                    Status.OutOfRange,
                    name + "[" + index.ToString(CultureInfo.InvariantCulture) + "]." + field +
                    " is " + shown + ", allowed 0 to 1.",
                    name);
            }
        }
    }
}
