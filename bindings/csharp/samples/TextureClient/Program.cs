using System;
using System.Diagnostics;
using System.Threading;
using PtLib;

namespace TextureClient
{
    /// <summary>
    /// What an editor does: it builds a graph in code, gives it colours from an array, changes a
    /// parameter in a loop, reports progress, and cancels. Only what a change concerns is computed
    /// again: the noise, which costs most, comes from the cache.
    /// </summary>
    internal static class Program
    {
        private const int Size = 1024;

        private static void Main()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                graph.SetSize(Size, Size);
                graph.Seed = 7;
                var noise = graph.Add("perlin noise");
                var contrast = graph.Add("brightness and contrast");
                var end = Colours(graph, noise, contrast);

                Console.WriteLine("first:      " + Measure(graph, end) + " ms");
                for (var i = 1; i <= 5; i++)
                {
                    contrast.Set("contrast", 5 * i);
                    Console.WriteLine("contrast " + (5 * i) + ": " + Measure(graph, end) + " ms");
                }
                Cancel(graph, noise, end);
                using (var image = graph.Compute(end, null, new Bar()))
                {
                    Console.WriteLine();
                    image.Save("TextureClient.png");
                }
            }
        }

        /// <summary>noise → contrast → colours → end; returns the end.</summary>
        private static Block Colours(Graph graph, Block noise, Block contrast)
        {
            var colours = graph.Add("gradient input").Set("name", "colours");
            var map = graph.Add("map transition");
            var end = graph.Add("end");
            graph.Connect(noise, contrast);
            graph.Connect(contrast, map, input: 0);
            graph.Connect(colours, map, input: 1);
            graph.Connect(map, end);
            using (var gradient = Gradient.FromStops(
                new GradientStop(0, 0.05f, 0.02f, 0.1f),
                new GradientStop(0.5f, 0.8f, 0.3f, 0.1f),
                new GradientStop(1, 1, 0.9f, 0.6f)))
            {
                graph.SetInput("colours", gradient);
            }
            return end;
        }

        private static long Measure(Graph graph, Block end)
        {
            var watch = Stopwatch.StartNew();
            graph.Compute(end).Dispose();
            return watch.ElapsedMilliseconds;
        }

        /// <summary>Starts a large picture, and gives up after a moment.</summary>
        private static void Cancel(Graph graph, Block noise, Block end)
        {
            noise.SetSeed(8);
            var large = new ComputeOptions { Width = 8192, Height = 8192 };
            using (var source = new CancellationTokenSource(TimeSpan.FromMilliseconds(20)))
            {
                try
                {
                    graph.ComputeAsync(end, large, null, source.Token)
                        .GetAwaiter().GetResult().Dispose();
                    Console.WriteLine("faster than the cancelling");
                }
                catch (OperationCanceledException)
                {
                    Console.WriteLine("cancelled");
                }
            }
        }

        private sealed class Bar : IProgress<double>
        {
            public void Report(double value)
            {
                Console.Write("\r" + (int)(value * 100) + " %");
            }
        }
    }
}
