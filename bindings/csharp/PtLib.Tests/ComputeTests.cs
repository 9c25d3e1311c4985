using System;
using System.Diagnostics;
using System.IO;

namespace PtLib.Tests
{
    /// <summary>Computing, and the pixels that come out.</summary>
    internal static class ComputeTests
    {
        internal static void Run(Runner runner)
        {
            runner.Run("compute: the pictures of the command in Rust", Golden);
            runner.Run("compute: into memory of the caller", Into);
            runner.Run("compute: band by band", Bands);
            runner.Run("compute: formats, rows and copies", Formats);
            runner.Run("compute: options", Options);
            runner.Run("compute: a job", Jobs);
            runner.Run("compute: a picture file", Saving);
#if NET8_0_OR_GREATER
            runner.Run("compute: spans and memory", Spans);
#endif
        }

        // The files that `ptc`, which is Rust, renders of the example graphs, byte by byte.
        private static void Golden()
        {
            var ptc = Environment.GetEnvironmentVariable("PTLIB_TEST_PTC");
            if (string.IsNullOrEmpty(ptc))
            {
                Console.WriteLine("(no ptc to compare with: set PTLIB_TEST_PTC)");
                return;
            }
            var folder = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName());
            Directory.CreateDirectory(folder);
            try
            {
                foreach (var name in new[] { "bark", "marble-floor", "stained-glass", "sea" })
                {
                    Compare(ptc, Repository.File("examples/graphs/" + name + ".xml"), folder);
                }
            }
            finally
            {
                Directory.Delete(folder, true);
            }
        }

        private static void Compare(string ptc, string graphFile, string folder)
        {
            var theirs = Path.Combine(folder, "theirs.png");
            var ours = Path.Combine(folder, "ours.png");
            var start = new ProcessStartInfo(
                ptc, "render \"" + graphFile + "\" --size 96x96 -o \"" + theirs + "\"")
            {
                UseShellExecute = false,
                RedirectStandardError = true,
                RedirectStandardOutput = true,
            };
            using (var process = Process.Start(start))
            {
                var said = process.StandardError.ReadToEnd();
                process.WaitForExit();
                Assert.True(process.ExitCode == 0, "ptc renders: " + said);
            }
            using (var engine = new Engine())
            using (var graph = engine.LoadGraphFile(graphFile))
            using (var image = graph.Compute(
                graph.MainResult.Value, new ComputeOptions { Width = 96, Height = 96 }))
            {
                image.Save(ours);
            }
            Assert.Same(Pixels(theirs), Pixels(ours));
            File.Delete(theirs);
        }

        /// <summary>The pixels of a picture, as the engine reads them.</summary>
        private static byte[] Pixels(string picture)
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                graph.SetSize(96, 96);
                graph.SetFolder(Path.GetDirectoryName(picture));
                var file = graph.Add("load file").Set("path", Path.GetFileName(picture));
                using (var image = graph.Compute(
                    file, new ComputeOptions { Format = PixelFormat.Rgba8 }))
                {
                    return image.ToArray();
                }
            }
        }

        private static void Into()
        {
            var options = new ComputeOptions { Format = PixelFormat.Rgb8 };
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var end = GraphTests.Build(graph);
                using (var image = graph.Compute(end, options))
                {
                    var pixels = new byte[64 * 64 * 3];
                    graph.ComputeInto(end, pixels, options);
                    Assert.Same(image.ToArray(), pixels);
                }
                var wide = new byte[64 * 200];
                graph.ComputeInto(end, wide, options, 200);
                Assert.Equal((byte)0, wide[64 * 3]);
                Assert.Fails(
                    Status.BufferTooSmall, () => graph.ComputeInto(end, new byte[5], options));
                Assert.Fails(
                    Status.InvalidArgument, () => graph.ComputeInto(end, default(byte[]), options));
            }
        }

        private static void Bands()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var end = GraphTests.Build(graph);
                var options = new ComputeOptions { Format = PixelFormat.Rgb8 };
                var all = new byte[64 * 64 * 3];
                var next = 0;
                graph.ComputeBands(
                    end,
                    band =>
                    {
                        Assert.Equal(next, band.FirstRow);
                        Assert.Equal(64, band.Width);
                        Assert.Equal(PixelFormat.Rgb8, band.Format);
                        var bytes = band.ToArray();
                        bytes.CopyTo(all, next * band.RowStride);
                        next += band.Rows;
                        return true;
                    },
                    options,
                    30);
                Assert.Equal(64, next);
                using (var image = graph.Compute(end, options))
                {
                    Assert.Same(image.ToArray(), all);
                }
                Assert.Throws<OperationCanceledException>(
                    () => graph.ComputeBands(end, band => false, options));
                Assert.Throws<FormatException>(
                    () => graph.ComputeBands(end, band => { throw new FormatException(); }));
                Band kept = null;
                graph.ComputeBands(end, band => { kept = band; return true; });
                Assert.Throws<ObjectDisposedException>(() => kept.ToArray());
            }
        }

        private static void Formats()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var end = GraphTests.Build(graph);
                using (var image = graph.Compute(
                    end, new ComputeOptions { Format = PixelFormat.RgbFloat }))
                {
                    Assert.Equal(64, image.Width);
                    Assert.Equal(3, image.Channels);
                    Assert.Equal(4, image.BytesPerChannel);
                    Assert.Equal(64 * 12, image.RowStride);
                    var top = image.ToFloatArray();
                    var bottom = new float[64 * 64 * 3];
                    image.CopyTo(bottom, PixelFormat.RgbFloat, RowOrder.BottomUp);
                    for (var i = 0; i < 64 * 3; i++)
                    {
                        Assert.Equal(top[i], bottom[(63 * 64 * 3) + i]);
                    }
                    var words = new ushort[64 * 64];
                    image.CopyTo(words, PixelFormat.Grey16);
                    Assert.Equal((int)((top[0] * 65535) + 0.5f), words[0]);
                    Assert.Fails(Status.BufferTooSmall, () => image.CopyTo(new byte[3]));
                }
            }
        }

        private static void Options()
        {
            using (var engine = new Engine(new EngineOptions { Threads = 1, DisableCache = true }))
            using (var graph = engine.CreateGraph())
            {
                var end = GraphTests.Build(graph);
                var small = new ComputeOptions { Width = 16, Height = 8, Seed = 3 };
                using (var image = graph.Compute(end, small))
                {
                    Assert.Equal(16, image.Width);
                    Assert.Equal(8, image.Height);
                }
                Assert.Fails(
                    Status.Limit,
                    () => graph.Compute(end, new ComputeOptions { MemoryLimit = 1 }));
                Assert.Throws<ArgumentOutOfRangeException>(
                    () => graph.Compute(end, new ComputeOptions { Width = -1 }));
                Assert.Fails(Status.NotFound, () => graph.Compute(end, null, output: 5));
            }
        }

        private static void Jobs()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var end = GraphTests.Build(graph);
                using (var job = graph.Start(end))
                using (var image = job.Wait())
                {
                    Assert.True(job.IsDone, "it is done");
                    Assert.Equal(1.0, job.Progress);
                    Assert.Equal(64, image.Width);
                }
                using (graph.Start(end, new ComputeOptions { Width = 4096, Height = 4096 }))
                {
                    // Its end cancels it.
                }
                graph.Disconnect(end);
                using (var job = graph.Start(end))
                {
                    Assert.Fails(Status.Unconnected, () => job.Wait());
                }
            }
        }

        private static void Saving()
        {
            var path = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName() + ".png");
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            using (var image = graph.Compute(GraphTests.Build(graph)))
            {
                image.Save(path);
                Assert.Equal((byte)'P', File.ReadAllBytes(path)[1]);
                File.Delete(path);
                Assert.Fails(Status.Io, () => image.Save("/no/such/folder/a.png"));
                Assert.Fails(Status.Unsupported, () => image.Save("a.xyz"));
            }
        }

#if NET8_0_OR_GREATER
        private static void Spans()
        {
            using var engine = new Engine();
            using var graph = engine.CreateGraph();
            var end = GraphTests.Build(graph);
            var image = graph.Compute(end, new ComputeOptions { Format = PixelFormat.GreyFloat });
            var floats = image.ToFloatArray();
            Assert.True(image.PixelsAs<float>().SequenceEqual(floats), "the same floats");
            Assert.Throws<InvalidOperationException>(() => image.PixelsAs<byte>());
            Span<float> target = new float[64 * 64];
            image.CopyTo(target);
            Assert.True(target.SequenceEqual(floats), "copied");
            target.Clear();
            graph.ComputeInto(end, target, new ComputeOptions { Format = PixelFormat.GreyFloat });
            Assert.True(target.SequenceEqual(floats), "computed there");
            var memory = image.Memory;
            Assert.Equal(64 * 64 * 4, memory.Length);
            using (var pin = memory.Pin())
            {
                Assert.Equal(memory.Span[0], image.Pixels[0]);
            }
            image.Dispose();
            Assert.Throws<ObjectDisposedException>(() => memory.Span[0].ToString());
        }
#endif
    }
}
