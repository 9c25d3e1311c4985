using System;
using System.Text;

namespace PtLib.Tests
{
    /// <summary>Graphs: building, describing, saving.</summary>
    internal static class GraphTests
    {
        internal static void Run(Runner runner)
        {
            runner.Run("graph: block types are described", Types);
            runner.Run("graph: built, saved and read again", RoundTrip);
            runner.Run("graph: parameters of every kind", Parameters);
            runner.Run("graph: errors have status, block and parameter", Failures);
            runner.Run("graph: all faults of a file", Faults);
            runner.Run("graph: seeds", Seeds);
            runner.Run("graph: blocks of other graphs are refused", OtherGraphs);
        }

        /// <summary>perlin noise → blur → end, 64 × 64.</summary>
        internal static Block Build(Graph graph)
        {
            graph.SetSize(64, 64);
            graph.Seed = 7;
            var noise = graph.Add("perlin noise");
            var blur = graph.Add("blur");
            var end = graph.Add("end");
            graph.Connect(noise, blur);
            graph.Connect(blur, end);
            return end;
        }

        private static void Types()
        {
            using (var engine = new Engine())
            {
                Assert.True(engine.BlockTypes.Count > 40, "the built-in block types");
                var type = engine.FindBlockType("voronoi diagram");
                Assert.Equal("noise", type.Category);
                Assert.True((type.Flags & BlockTypeFlags.UsesSeed) != 0, "it uses the seed");
                Assert.Equal(ValueKind.Image, type.Outputs[0].Kind);
                Assert.True(type.Inputs[0].IsOptional, "the L-system is optional");
                var metric = type.Parameters[1];
                Assert.Equal("metric", metric.Id);
                Assert.Equal(ParameterKind.Choice, metric.Kind);
                Assert.Equal("taxicab", metric.Choices[1].Id);
                Assert.True(engine.FindBlockType("no such") == null, "null for unknown ids");
            }
        }

        private static void RoundTrip()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var end = Build(graph);
                graph.Supersampling = 2;
                graph.Precision = Precision.Float;
                Assert.Equal(3, graph.Blocks.Count);
                Assert.True(graph.MainResult == end, "end is the main result");
                Assert.Equal("blur", graph.Source(end).Value.Block.TypeId);
                var file = graph.Save();
                using (var again = engine.LoadGraph(file))
                {
                    Assert.Equal(64, again.Width);
                    Assert.Equal(2, again.Supersampling);
                    Assert.Equal(Precision.Float, again.Precision);
                    Assert.Equal(0, again.Warnings.Count);
                    Assert.Same(file, again.Save());
                }
                using (var copy = graph.Clone())
                {
                    copy.Remove(copy.FromHandle(end.Handle));
                    Assert.Equal(2, copy.Blocks.Count);
                    Assert.Equal(3, graph.Blocks.Count);
                }
                graph.Disconnect(end);
                Assert.True(graph.Source(end) == null, "nothing is connected");
                Assert.Fails(Status.Unconnected, () => graph.Validate(end));
            }
        }

        private static void Parameters()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var cells = graph.Add("voronoi diagram")
                    .Set("initial x", 0.25).Set("number of points", 30).Set("metric", "chebyshev");
                Assert.Equal(0.25, cells.GetDouble("initial x"));
                Assert.Equal("0.25", cells.GetText("initial x"));
                Assert.Equal(30L, cells.GetInt64("number of points"));
                Assert.Equal(2L, cells.GetInt64("metric"));
                Assert.Equal(30L, cells.Set("initial x", "0.5").GetInt64("number of points"));
                Assert.Equal(0.5, cells.GetDouble("initial x"));
                cells.Reset("number of points");
                Assert.Equal(15L, cells.GetInt64("number of points"));
                var input = graph.Add("text input").Set("name", "příliš žluťoučký kůň 🐎");
                Assert.Equal("příliš žluťoučký kůň 🐎", input.GetText("name"));
            }
        }

        private static void Failures()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var blur = graph.Add("blur");
                Assert.Fails(Status.NotFound, () => graph.Add("no such block"));
                Assert.Fails(Status.NotFound, () => blur.Set("no such", 1.0));
                Assert.Fails(Status.Cycle, () => graph.Connect(blur, blur));
                var cells = graph.Add("voronoi diagram");
                var error = Assert.Fails(Status.OutOfRange, () => cells.Set("initial x", 7.0));
                Assert.Equal(cells.Handle, error.BlockHandle);
                Assert.Equal("initial x", error.Parameter);
                Assert.Fails(Status.TypeMismatch, () => cells.Set("point positions", 1.5));
                graph.Remove(blur);
                Assert.Fails(Status.StaleHandle, () => graph.Remove(blur));
                Assert.Fails(Status.Io, () => engine.LoadGraphFile("/no/such/file.xml"));
                Assert.Fails(Status.PluginLoad, () => engine.LoadPlugin("/no/such.ptplugin.so"));
                Assert.Throws<ArgumentNullException>(() => graph.Add(null));
                Assert.Throws<ArgumentException>(() => graph.Add("per\0lin"));
                Assert.Throws<ArgumentOutOfRangeException>(() => graph.SetSize(-1, 5));
            }
        }

        private static void Faults()
        {
            const string file =
                "<!DOCTYPE ptgraph>\n<texturegraph width=\"64\" height=\"64\" seed=\"7\" " +
                "supersampling=\"1\" version=\"1\">\n<block type=\"blur\"/>\n" +
                "<block id=\"x\"/>\n</texturegraph>";
            using (var engine = new Engine())
            {
                var error = Assert.Fails(
                    Status.Parse, () => engine.LoadGraph(Encoding.UTF8.GetBytes(file)));
                Assert.True(error.Faults.Count >= 2, "all faults: " + error.Message);
                Assert.Equal(3, error.Faults[0].Line);
            }
        }

        private static void Seeds()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                graph.Seed = ulong.MaxValue;
                var noise = graph.Add("perlin noise");
                Assert.Equal(ulong.MaxValue, noise.Seed);
                Assert.True(!noise.HasOwnSeed, "it follows the graph");
                noise.SetSeed(5);
                Assert.True(noise.HasOwnSeed && noise.Seed == 5, "it has its own");
                noise.SetSeed(null);
                Assert.Equal(ulong.MaxValue, noise.Seed);
            }
        }

        private static void OtherGraphs()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            using (var other = engine.CreateGraph())
            {
                var block = other.Add("end");
                Assert.Throws<ArgumentException>(() => graph.Remove(block));
                Assert.Throws<InvalidOperationException>(() => graph.Remove(default(Block)));
            }
        }
    }
}
