using System;
using System.IO;

namespace PtLib.Aging.Tests
{
    /// <summary>A head for tests: a ball with the texture coordinates of a sphere, and an engine
    /// that can age it.</summary>
    internal static class Ball
    {
        private const int Columns = 24;
        private const int Rows = 16;

        internal static Engine Engine(int threads = 0, bool disableCache = false)
        {
            var engine = new Engine(
                new EngineOptions { Threads = threads, DisableCache = disableCache });
            var plugin = Environment.GetEnvironmentVariable("PTLIB_AGING_PLUGIN");
            if (string.IsNullOrEmpty(plugin))
            {
                throw new Exception("PTLIB_AGING_PLUGIN has to name the file of the plug-in");
            }
            engine.LoadPlugin(plugin);
            return engine;
        }

        internal static AgingSettings Small(AgingOutputs outputs)
        {
            return new AgingSettings { Size = 96, Hairs = 3000, Outputs = outputs };
        }

        internal static AgingInputMesh Mesh()
        {
            var vertices = new VertexPTN[(Columns + 1) * (Rows + 1)];
            for (var i = 0; i < vertices.Length; i++)
            {
                var u = i % (Columns + 1) / (float)Columns;
                var v = i / (Columns + 1) / (float)Rows;
                var around = (u - 0.5) * 2 * Math.PI;
                var up = (v - 0.5) * Math.PI;
                var place = new Point3(
                    (float)(Math.Cos(up) * Math.Sin(around)),
                    (float)Math.Sin(up),
                    (float)(Math.Cos(up) * Math.Cos(around)));
                vertices[i] = new VertexPTN(place, new Point2(u, v), place);
            }
            var indices = new uint[Columns * Rows * 6];
            for (var i = 0; i < Columns * Rows; i++)
            {
                var lower = (uint)((i / Columns * (Columns + 1)) + (i % Columns));
                var upper = lower + Columns + 1;
                new[] { lower, lower + 1, upper + 1, lower, upper + 1, upper }
                    .CopyTo(indices, i * 6);
            }
            return new AgingInputMesh(vertices, indices);
        }

        /// <summary>The path of a picture that is not there, in a folder that is.</summary>
        internal static string NoFile(string name)
        {
            return Path.Combine(Path.GetTempPath(), "no-such-" + name + ".png");
        }

        /// <summary>The result of a run in an engine of its own.</summary>
        internal static T With<T>(AgingSettings settings, Func<AgingResult, T> read)
        {
            using (var engine = Engine())
            using (var result = AgingSim.Run(engine, Mesh(), settings))
            {
                return read(result);
            }
        }
    }
}
