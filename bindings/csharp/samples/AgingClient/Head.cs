using System;
using PtLib;
using PtLib.Aging;

namespace AgingClient
{
    /// <summary>
    /// Something like a head: a sphere, narrower at the chin and with a nose. Its texture
    /// coordinates are those of a sphere, the face, which looks along z, in the middle.
    /// </summary>
    internal static class Head
    {
        private const double Small = 1e-3;

        /// <summary>Makes a head.</summary>
        /// <param name="columns">Pieces around it.</param>
        /// <param name="rows">Pieces from the chin to the crown.</param>
        /// <returns>The mesh. The seam at the back has its vertices twice.</returns>
        internal static AgingInputMesh Make(int columns, int rows)
        {
            var vertices = new VertexPTN[(columns + 1) * (rows + 1)];
            for (var i = 0; i < vertices.Length; i++)
            {
                var u = i % (columns + 1) / (double)columns;
                var v = i / (columns + 1) / (double)rows;
                vertices[i] = new VertexPTN(
                    Point(Surface(u, v)), new Point2((float)u, (float)v), Point(Normal(u, v)));
            }
            return new AgingInputMesh(vertices, Indices(columns, rows));
        }

        /// <summary>Two triangles for each piece, counter-clockwise from outside.</summary>
        private static uint[] Indices(int columns, int rows)
        {
            var indices = new uint[columns * rows * 6];
            var next = 0;
            for (var row = 0; row < rows; row++)
            {
                for (var column = 0; column < columns; column++)
                {
                    var lower = (uint)((row * (columns + 1)) + column);
                    var upper = (uint)(lower + columns + 1);
                    foreach (var index in new[]
                    {
                        lower, lower + 1, upper + 1, lower, upper + 1, upper,
                    })
                    {
                        indices[next++] = index;
                    }
                }
            }
            return indices;
        }

        /// <summary>The place of texture coordinates.</summary>
        private static double[] Surface(double u, double v)
        {
            var around = (u - 0.5) * 2 * Math.PI;
            var up = (v - 0.5) * Math.PI;
            var x = Math.Cos(up) * Math.Sin(around);
            var y = Math.Sin(up);
            var z = Math.Cos(up) * Math.Cos(around);
            var chin = y < 0 ? 1 - (0.3 * y * y) : 1;
            var nose = 0.11 * Bump(u - 0.5, 0.03) * Bump(v - 0.46, 0.05);
            return new[] { 0.8 * chin * x, 1.1 * y, (0.95 * chin * z) + nose };
        }

        private static double Bump(double distance, double width)
        {
            return Math.Exp(-(distance * distance) / (2 * width * width));
        }

        /// <summary>The normal, from two tangents. At the poles one of them vanishes.</summary>
        private static double[] Normal(double u, double v)
        {
            v = Math.Min(Math.Max(v, Small), 1 - Small);
            var right = Difference(Surface(u + Small, v), Surface(u - Small, v));
            var up = Difference(Surface(u, v + Small), Surface(u, v - Small));
            return new[]
            {
                (right[1] * up[2]) - (right[2] * up[1]),
                (right[2] * up[0]) - (right[0] * up[2]),
                (right[0] * up[1]) - (right[1] * up[0]),
            };
        }

        private static double[] Difference(double[] one, double[] other)
        {
            return new[] { one[0] - other[0], one[1] - other[1], one[2] - other[2] };
        }

        /// <summary>A point; the length of a normal does not matter.</summary>
        private static Point3 Point(double[] place)
        {
            var scale = Math.Sqrt(
                (place[0] * place[0]) + (place[1] * place[1]) + (place[2] * place[2]));
            scale = scale < 0.1 ? 1 / scale : 1;
            return new Point3(
                (float)(place[0] * scale), (float)(place[1] * scale), (float)(place[2] * scale));
        }
    }
}
