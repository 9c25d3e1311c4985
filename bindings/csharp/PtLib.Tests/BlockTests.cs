using System;
using System.Collections.Generic;
using System.Threading;
using PtLib.Blocks;

namespace PtLib.Tests
{
    /// <summary>Blocks written in C#.</summary>
    internal static class BlockTests
    {
        private static readonly ManagedPlugin Plugin = new ManagedPlugin(
            "tests", "1.0.0", "MIT", new Ramp(), new Upside(), new Faulty(), new Services());

        internal static void Run(Runner runner)
        {
            runner.Run("blocks: what they declare can be read", Declared);
            runner.Run("blocks: rows, on several threads", Rows);
            runner.Run("blocks: whole images, with an input", Images);
            runner.Run("blocks: an exception comes out as the cause", Exceptions);
            runner.Run("blocks: a wrong description is refused", WrongDescription);
            runner.Run("blocks: cancelling", Cancelling);
            runner.Run("blocks: functions and random numbers of the engine", OfTheEngine);
            runner.Run("blocks: inputs are only read", InputsAreRead);
        }

        private static void With(Action<Graph> action)
        {
            using (var engine = new Engine())
            {
                engine.Register(Plugin);
                engine.Register(Plugin);
                using (var graph = engine.CreateGraph())
                {
                    graph.SetSize(100, 60);
                    graph.Precision = Precision.Float;
                    action(graph);
                }
            }
        }

        private static void Declared()
        {
            using (var engine = new Engine())
            {
                engine.Register(Plugin);
                var type = engine.FindBlockType("tests.ramp");
                Assert.Equal("tests", type.PluginId);
                Assert.Equal("Rises from left to right.", type.Documentation);
                Assert.Equal(2, type.Parameters.Count);
                Assert.Equal(4.0, type.Parameters[0].Maximum);
                Assert.Equal("down", type.Parameters[1].Choices[1].Id);
                Assert.Equal(1, engine.FindBlockType("tests.upside").Inputs.Count);
            }
        }

        private static void Rows()
        {
            With(graph =>
            {
                var ramp = graph.Add("tests.ramp").Set("gain", 0.5).Set("direction", "down");
                var one = graph.Compute(ramp, new ComputeOptions { Threads = 1 });
                var many = graph.Compute(ramp, new ComputeOptions { Threads = 4 });
                var pixels = one.ToFloatArray();
                Assert.Same(pixels, many.ToFloatArray());
                Assert.Equal(0.5f * 30 / 60, pixels[30 * 100]);
                Assert.Fails(Status.OutOfRange, () => ramp.Set("gain", 5.0));
                one.Dispose();
                many.Dispose();
            });
        }

        private static void Images()
        {
            With(graph =>
            {
                var noise = graph.Add("perlin noise");
                var upside = graph.Add("tests.upside");
                Assert.Fails(Status.Unconnected, () => graph.Compute(upside));
                graph.Connect(noise, upside);
                using (var before = graph.Compute(noise))
                using (var after = graph.Compute(upside))
                {
                    var left = before.ToFloatArray();
                    var right = after.ToFloatArray();
                    for (var i = 0; i < 100; i++)
                    {
                        Assert.Equal(left[i], right[(59 * 100) + i]);
                    }
                }
            });
        }

        private static void Exceptions()
        {
            With(graph =>
            {
                var faulty = graph.Add("tests.faulty").Set("how", "prepare");
                var error = Assert.Fails(Status.PluginFailed, () => graph.Compute(faulty));
                Assert.Contains("in prepare", error.Message);
                Assert.True(error.InnerException is FormatException, "the cause");
                faulty.Set("how", "row");
                error = Assert.Fails(Status.PluginFailed, () => graph.Compute(faulty));
                Assert.Contains("in a row", error.Message);
                Assert.True(error.InnerException is IndexOutOfRangeException, "the cause");
                Assert.Contains("Faulty", error.InnerException.StackTrace);
            });
        }

        private static void WrongDescription()
        {
            using (var engine = new Engine())
            {
                var plugin = new ManagedPlugin("wrong", "1.0.0", "MIT", new Ramp());
                Assert.Fails(Status.PluginDescriptor, () => engine.Register(plugin));
                Assert.Throws<ArgumentNullException>(() => engine.Register(null));
            }
        }

        private static void Cancelling()
        {
            With(graph =>
            {
                using (var source = new CancellationTokenSource(50))
                {
                    var slow = graph.Add("tests.faulty").Set("how", "wait");
                    Assert.Throws<OperationCanceledException>(
                        () => graph.Compute(slow, null, null, source.Token));
                }
            });
        }

        private static void OfTheEngine()
        {
            With(graph =>
            {
                using (var image = graph.Compute(graph.Add("tests.services")))
                {
                    var pixels = image.ToFloatArray();
                    Assert.True(Math.Abs(Math.Sin(0.5) - pixels[0]) < 1e-7, "sin");
                    Assert.True(Math.Abs(Math.Atan2(1, 2) - pixels[1]) < 1e-7, "atan2");
                    Assert.True(Math.Abs(Math.Pow(0.5, 0.25) - pixels[2]) < 1e-7, "pow");
                    Assert.True(pixels[3] >= 0 && pixels[3] < 1, "uniform");
                    Assert.True(pixels[3] != pixels[4], "another item, another number");
                    Assert.Equal(0.5f, pixels[5]);
                }
            });
        }

        private static void InputsAreRead()
        {
            With(graph =>
            {
                var upside = graph.Add("tests.upside").Set("spoil", true);
                graph.Connect(graph.Add("perlin noise"), upside);
                var error = Assert.Fails(Status.PluginFailed, () => graph.Compute(upside));
                Assert.True(error.InnerException is InvalidOperationException, "the cause");
            });
        }

        private sealed class Services : ImageBlock<string>
        {
            internal Services()
                : base("tests.services", "Asks the engine.")
            {
            }

            protected override string Prepare(BlockSetup setup)
            {
                return string.Empty;
            }

            protected override void Compute(string state, BlockCall call)
            {
                for (var y = 0; y < call.Output.Height; y++)
                {
                    var row = call.Output.Row(0, y);
                    for (var x = 0; x < row.Length; x++)
                    {
                        row[x] = 0;
                    }
                }
                var samples = call.Output.Row(0, 0);
                samples[0] = (float)EngineMath.Sin(0.5);
                samples[1] = (float)EngineMath.Atan2(1, 2);
                samples[2] = (float)EngineMath.Pow(0.5, 0.25);
                samples[3] = EngineNoise.Uniform(7, 1, 0, 0);
                samples[4] = EngineNoise.Uniform(7, 2, 0, 0);
                samples[5] = (float)EngineMath.Cbrt(0.125);
            }
        }

        private sealed class Ramp : RowBlock<Ramp.State>
        {
            private readonly BlockParameter gain;
            private readonly BlockParameter direction;

            internal Ramp()
                : base("tests.ramp", "Rises from left to right.")
            {
                gain = AddNumber("gain", "How much.", 0, 4, 1);
                direction = AddChoice("direction", "Where to.", 0, "right", "down");
                TilingException = "it rises";
            }

            protected override State Prepare(BlockSetup setup)
            {
                return new State
                {
                    Gain = (float)setup.GetDouble(gain),
                    IsDown = setup.GetInt64(direction) == 1,
                };
            }

            protected override void Row(State state, BlockCall call, int row)
            {
                var output = call.Output;
                var samples = output.Row(0, row);
                for (var i = 0; i < samples.Length; i++)
                {
                    samples[i] = state.IsDown
                        ? state.Gain * (output.Y + row) / output.ImageHeight
                        : state.Gain * (output.X + i) / output.ImageWidth;
                }
            }

            internal sealed class State
            {
                internal float Gain { get; set; }

                internal bool IsDown { get; set; }
            }
        }

        private sealed class Upside : ImageBlock<string>
        {
            private readonly int image;
            private readonly BlockParameter spoil;

            internal Upside()
                : base("tests.upside", "Turns an image upside down.")
            {
                image = AddInput("image");
                spoil = AddFlag("spoil", "Writes into the input.", false);
            }

            protected override string Prepare(BlockSetup setup)
            {
                return setup.GetBoolean(spoil) ? "spoil" : string.Empty;
            }

            protected override void Compute(string state, BlockCall call)
            {
                var input = call.Input(image);
                if (state.Length > 0)
                {
                    var samples = input.Row(0, 0);
                    samples[0] = 1;
                }
                for (var y = 0; y < input.Height; y++)
                {
                    call.ThrowIfCancelled();
                    var source = input.Row(0, y);
                    var target = call.Output.Row(0, input.Height - 1 - y);
                    for (var x = 0; x < source.Length; x++)
                    {
                        target[x] = source[x];
                    }
                    call.Report((y + 1.0) / input.Height);
                }
            }
        }

        private sealed class Faulty : RowBlock<string>
        {
            private readonly BlockParameter how;

            internal Faulty()
                : base("tests.faulty", "Fails in some way.")
            {
                how = AddText("how", "In which way.", "row");
            }

            protected override string Prepare(BlockSetup setup)
            {
                var way = setup.GetText(how);
                if (way == "prepare")
                {
                    throw new FormatException("in prepare");
                }
                return way;
            }

            protected override void Row(string state, BlockCall call, int row)
            {
                if (state == "row")
                {
                    throw new IndexOutOfRangeException("in a row");
                }
                while (state == "wait")
                {
                    call.ThrowIfCancelled();
                    Thread.Sleep(1);
                }
            }
        }
    }
}
