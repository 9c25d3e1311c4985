using System;
using PtLib.Native;

namespace PtLib
{
    // Parameters.
    public readonly unsafe partial struct Block
    {
        /// <summary>Sets a number.</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <param name="value">The number.</param>
        /// <returns>This block.</returns>
        /// <exception cref="PtLibException">There is no such parameter, it holds something else,
        /// or the number is out of its range; then it keeps its value.</exception>
        public Block Set(string parameter, double value)
        {
            IntPtr error;
            using (var owner = Graph.Use())
            fixed (byte* text = Utf8.Of(parameter, nameof(parameter)))
            {
                var status = NativeMethods.ptl_graph_set_float(
                    owner.Pointer, Handle, text, &value, 1, &error);
                Errors.Check(status, error);
            }
            return this;
        }

        /// <summary>Sets a whole number, or a choice by the number of its alternative.</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <param name="value">The number.</param>
        /// <returns>This block.</returns>
        /// <exception cref="PtLibException">There is no such parameter, it holds something else,
        /// or the number is out of its range; then it keeps its value.</exception>
        public Block Set(string parameter, long value)
        {
            IntPtr error;
            using (var owner = Graph.Use())
            fixed (byte* text = Utf8.Of(parameter, nameof(parameter)))
            {
                var status = NativeMethods.ptl_graph_set_int(
                    owner.Pointer, Handle, text, value, &error);
                Errors.Check(status, error);
            }
            return this;
        }

        /// <summary>Sets a whole number, or a choice by the number of its alternative.</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <param name="value">The number.</param>
        /// <returns>This block.</returns>
        /// <exception cref="PtLibException">There is no such parameter, it holds something else,
        /// or the number is out of its range; then it keeps its value.</exception>
        public Block Set(string parameter, int value)
        {
            return Set(parameter, (long)value);
        }

        /// <summary>Sets a flag.</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <param name="value">Whether it is set.</param>
        /// <returns>This block.</returns>
        /// <exception cref="PtLibException">There is no such parameter, or it holds something
        /// else.</exception>
        public Block Set(string parameter, bool value)
        {
            return Set(parameter, value ? 1L : 0L);
        }

        /// <summary>
        /// Sets a parameter of any kind from a text: a number with a decimal point, "true" or
        /// "false", the id or the number of an alternative, or the text itself.
        /// </summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <param name="value">The text.</param>
        /// <returns>This block.</returns>
        /// <exception cref="PtLibException">There is no such parameter, or it cannot be that; then
        /// it keeps its value.</exception>
        public Block Set(string parameter, string value)
        {
            IntPtr error;
            using (var owner = Graph.Use())
            fixed (byte* name = Utf8.Of(parameter, nameof(parameter)))
            fixed (byte* text = Utf8.Of(value, nameof(value)))
            {
                var status = NativeMethods.ptl_graph_set_text(
                    owner.Pointer, Handle, name, text, &error);
                Errors.Check(status, error);
            }
            return this;
        }

        /// <summary>
        /// Sets a text that lists points, such as "point positions" of a Voronoi diagram.
        /// </summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <param name="points">The points; each coordinate 0 to 1.</param>
        /// <returns>This block.</returns>
        /// <exception cref="PtLibException">There is no such parameter, the array is null, or a
        /// point is outside of 0 to 1; the message names its index.</exception>
        public Block Set(string parameter, Point2[] points)
        {
            return Set(parameter, ListText.Of(points, nameof(points)));
        }

        /// <summary>
        /// Sets a text that lists colours, such as "data" of a color transition. There, positions
        /// and colours are whole numbers of 0 to 255: they are rounded. Use a block "gradient
        /// input" and <see cref="Gradient.FromStops"/> where that is too coarse.
        /// </summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <param name="stops">The colours; every number 0 to 1.</param>
        /// <returns>This block.</returns>
        /// <exception cref="PtLibException">There is no such parameter, the array is null, or a
        /// number is outside of 0 to 1; the message names its index.</exception>
        public Block Set(string parameter, GradientStop[] stops)
        {
            return Set(parameter, ListText.Of(stops, nameof(stops)));
        }

        /// <summary>Sets a parameter to its default.</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <returns>This block.</returns>
        public Block Reset(string parameter)
        {
            IntPtr error;
            using (var owner = Graph.Use())
            fixed (byte* text = Utf8.Of(parameter, nameof(parameter)))
            {
                var status = NativeMethods.ptl_graph_reset_param(
                    owner.Pointer, Handle, text, &error);
                Errors.Check(status, error);
            }
            return this;
        }

        /// <summary>The value of a parameter that is a number, a flag or a choice.</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <returns>The number.</returns>
        public double GetDouble(string parameter)
        {
            IntPtr error;
            double value = 0;
            using (var owner = Graph.Use())
            fixed (byte* text = Utf8.Of(parameter, nameof(parameter)))
            {
                var status = NativeMethods.ptl_graph_get_float(
                    owner.Pointer, Handle, text, &value, 1, null, &error);
                Errors.Check(status, error);
            }
            return value;
        }

        /// <summary>The value of a parameter that is a whole number, a flag (0 or 1) or a choice
        /// (its number).</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <returns>The number.</returns>
        public long GetInt64(string parameter)
        {
            IntPtr error;
            long value = 0;
            using (var owner = Graph.Use())
            fixed (byte* text = Utf8.Of(parameter, nameof(parameter)))
            {
                var status = NativeMethods.ptl_graph_get_int(
                    owner.Pointer, Handle, text, &value, &error);
                Errors.Check(status, error);
            }
            return value;
        }

        /// <summary>The value of a parameter that is a flag.</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <returns>Whether it is set.</returns>
        public bool GetBoolean(string parameter)
        {
            return GetInt64(parameter) != 0;
        }

        /// <summary>The value of a parameter of any kind as a text, which
        /// <see cref="Set(string, string)"/> takes.</summary>
        /// <param name="parameter">The id of the parameter.</param>
        /// <returns>The text; a choice as the id of its alternative.</returns>
        public string GetText(string parameter)
        {
            IntPtr bytes, error;
            using (var owner = Graph.Use())
            fixed (byte* text = Utf8.Of(parameter, nameof(parameter)))
            {
                var status = NativeMethods.ptl_graph_get_text(
                    owner.Pointer, Handle, text, &bytes, &error);
                Errors.Check(status, error);
            }
            return Utf8.Take(bytes);
        }
    }
}
