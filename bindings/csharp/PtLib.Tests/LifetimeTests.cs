using System;
using System.Diagnostics;
using System.Runtime.CompilerServices;

namespace PtLib.Tests
{
    /// <summary>Who lives how long.</summary>
    internal static class LifetimeTests
    {
        internal static void Run(Runner runner)
        {
            runner.Run("lifetime: disposed objects say so", Disposed);
            runner.Run("lifetime: any order of disposing", AnyOrder);
            runner.Run("lifetime: a thousand abandoned images", Abandoned);
        }

        private static void Disposed()
        {
            var engine = new Engine();
            var graph = engine.CreateGraph();
            var end = GraphTests.Build(graph);
            var image = graph.Compute(end);
            image.Dispose();
            image.Dispose();
            Assert.Throws<ObjectDisposedException>(() => image.ToArray());
            Assert.Equal(64, image.Width);
            graph.Dispose();
            var error = Assert.Throws<ObjectDisposedException>(() => graph.Compute(end));
            Assert.Equal("PtLib.Graph", error.ObjectName);
            Assert.Throws<ObjectDisposedException>(() => end.Set("x", 1));
            engine.Dispose();
            Assert.Throws<ObjectDisposedException>(() => engine.CreateGraph());
        }

        private static void AnyOrder()
        {
            var engine = new Engine();
            var graph = engine.CreateGraph();
            var end = GraphTests.Build(graph);
            engine.Dispose();
            var image = graph.Compute(end);
            Assert.Equal("end", end.Type.Id);
            graph.Dispose();
            Assert.Equal(64 * 64 * image.Channels, image.ToFloatArray().Length);
            image.Dispose();
        }

        private static void Abandoned()
        {
            var options = new ComputeOptions
            {
                Width = 512,
                Height = 512,
                Format = PixelFormat.RgbaFloat,
            };
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var end = graph.Add("end");
                graph.Connect(graph.Add("color fill"), end);
                for (var i = 0; i < 1000; i++)
                {
                    Abandon(graph, end, options);
                }
            }
            GC.Collect();
            GC.WaitForPendingFinalizers();
            // All of them together would take 4 GB.
            var used = Process.GetCurrentProcess().PeakWorkingSet64;
            Assert.True(used < 1500L << 20, "bounded memory, not " + (used >> 20) + " MB");
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static void Abandon(Graph graph, Block end, ComputeOptions options)
        {
            var image = graph.Compute(end, options);
            Assert.True(image.PixelPointer != IntPtr.Zero, "pixels");
        }
    }
}
