using System;
using System.Threading;
using PtLib.Blocks;
using PtLib.Tests;

namespace PtLib.Aging.Tests
{
    /// <summary>The graph behind a run.</summary>
    internal static class GraphTests
    {
        private static readonly string[] Names =
        {
            "head", "height", "normals", "loss age", "roots", "hair", "view",
        };

        internal static void Run(Runner runner)
        {
            runner.Run("graph: blocks have names, also in its file", Named);
            runner.Run("graph: computed by hand it gives what a run gives", ByHand);
            runner.Run("graph: another age alone", Ages);
            runner.Run("graph: another age computes neither wrinkles nor regions again", Reuses);
            runner.Run("graph: a head is needed", NeedsHead);
        }

        private static void Named()
        {
            using (var engine = Ball.Engine())
            using (var graph = AgingSim.CreateGraph(engine))
            {
                Assert.Equal(1024, graph.Width);
                Assert.Equal(Precision.Float, graph.Precision);
                Assert.Equal(string.Empty, string.Join("\n", graph.Warnings));
                using (var again = engine.LoadGraph(graph.Save()))
                {
                    Assert.Equal(0, again.Warnings.Count);
                    foreach (var name in Names)
                    {
                        Assert.Equal(
                            graph.Find(name).Value.TypeId, again.Find(name).Value.TypeId);
                    }
                    Assert.True(again.FindInput("head").HasValue, "the mesh");
                    Assert.True(again.FindInput("inner hair").HasValue, "a region");
                }
            }
        }

        private static void ByHand()
        {
            var settings = Ball.Small(AgingOutputs.All);
            using (var engine = Ball.Engine())
            using (var graph = AgingSim.CreateGraph(engine, settings))
            using (var mesh = Ball.Mesh().ToMesh())
            using (var result = AgingSim.Run(engine, Ball.Mesh(), settings))
            {
                graph.SetInput("head", mesh);
                using (var view = graph.Compute(
                    graph.Find("view").Value, new ComputeOptions { Format = PixelFormat.Rgba8 }))
                {
                    Assert.Same(result.View.ToArray(), view.ToArray());
                }
                using (var hair = (Strands)graph.ComputeValue(graph.Find("hair").Value))
                {
                    Assert.Same(
                        result.Hair.ToArray<Point3>("position"),
                        hair.ToArray<Point3>("position"));
                }
            }
        }

        private static void Ages()
        {
            var settings = Ball.Small(AgingOutputs.View);
            settings.FineTile = new[] { 0f, 1f, 1f, 0f };
            using (var engine = Ball.Engine())
            using (var graph = AgingSim.CreateGraph(engine, settings))
            using (var mesh = Ball.Mesh().ToMesh())
            {
                graph.SetInput("head", mesh);
                foreach (var age in new[] { 0, 0.3, 1 })
                {
                    AgingSim.SetAge(graph, age);
                    settings.Age = age;
                    using (var view = graph.Compute(
                        graph.Find("view").Value,
                        new ComputeOptions { Format = PixelFormat.Rgba8 }))
                    {
                        Assert.Same(
                            Ball.With(settings, result => result.View.ToArray()), view.ToArray());
                    }
                }
                Assert.Fails(Status.OutOfRange, () => AgingSim.SetAge(graph, 1.5));
                using (var other = engine.CreateGraph())
                {
                    Assert.Fails(Status.NotFound, () => AgingSim.SetAge(other, 0.5));
                }
                Assert.Throws<ArgumentNullException>(() => AgingSim.SetAge(null, 0.5));
            }
        }

        private static void Reuses()
        {
            var settings = Ball.Small(AgingOutputs.View);
            var counter = new Counter();
            using (var engine = Ball.Engine())
            using (var graph = AgingSim.CreateGraph(engine, settings))
            using (var mesh = Ball.Mesh().ToMesh())
            {
                engine.Register(new ManagedPlugin("tests", "1.0.0", "MIT", counter));
                graph.SetInput("head", mesh);
                // In place of the wrinkle map, and behind a region.
                graph.Connect(graph.Add("tests.counter"), graph.Find("height").Value);
                var region = graph.Add("tests.counter");
                graph.Connect(graph.Find("outer hair").Value, region);
                graph.Connect(region, graph.Find("loss age").Value);
                var view = graph.Find("view").Value;
                graph.Compute(view).Dispose();
                var rows = counter.Rows;
                Assert.True(rows >= 2 * settings.Size, "both were computed, " + rows);
                for (var age = 0; age <= 4; age++)
                {
                    AgingSim.SetAge(graph, age / 4.0);
                    graph.Compute(view).Dispose();
                }
                Assert.Equal(rows, counter.Rows);
            }
        }

        private static void NeedsHead()
        {
            using (var engine = Ball.Engine())
            using (var graph = AgingSim.CreateGraph(engine, Ball.Small(AgingOutputs.View)))
            {
                var error = Assert.Fails(
                    Status.Unconnected, () => graph.Compute(graph.Find("view").Value));
                Assert.Contains("head", error.Message);
            }
        }

        /// <summary>Passes an image on, or makes one, and counts its rows.</summary>
        private sealed class Counter : RowBlock<string>
        {
            private readonly int image;
            private int rows;

            internal Counter()
                : base("tests.counter", "Counts rows.")
            {
                image = AddInput("image", true);
            }

            internal int Rows
            {
                get { return Volatile.Read(ref rows); }
            }

            protected override string Prepare(BlockSetup setup)
            {
                return string.Empty;
            }

            protected override void Row(string state, BlockCall call, int row)
            {
                Interlocked.Increment(ref rows);
                var source = call.Input(image);
                var target = call.Output.Row(0, row);
                for (var i = 0; i < target.Length; i++)
                {
                    target[i] = source.IsPresent ? source.Row(0, row)[i] : 0.5f;
                }
            }
        }
    }
}
