using System;
using System.Collections.Generic;
using System.Linq;
using System.Threading;
using System.Threading.Tasks;
using PtLib.Tests;

namespace PtLib.Aging.Tests
{
    /// <summary>Runs: their bits, their progress, their end before the end.</summary>
    internal static class RunTests
    {
        internal static void Run(Runner runner)
        {
            runner.Run("run: the same bits again, and with any number of threads", SameBits);
            runner.Run("run: progress", Progress);
            runner.Run("run: an exception in the progress comes out", Throwing);
            runner.Run("run: cancelled by the progress", Cancelling);
            runner.Run("run: cancelled before it starts", Cancelled);
            runner.Run("run: on another thread, with copies", Async);
            runner.Run("run: without the plug-in", WithoutPlugin);
        }

        private static void SameBits()
        {
            var settings = Ball.Small(AgingOutputs.All);
            settings.FineTile = Enumerable.Range(0, 64).Select(i => i % 8 / 8f).ToArray();
            byte[] wanted = null;
            foreach (var threads in new[] { 1, 2, 0 })
            {
                using (var engine = Ball.Engine(threads, disableCache: true))
                {
                    for (var again = 0; again < 2; again++)
                    {
                        using (var result = AgingSim.Run(engine, Ball.Mesh(), settings))
                        {
                            var bits = Bits(result);
                            wanted = wanted ?? bits;
                            Assert.Same(wanted, bits);
                        }
                    }
                }
            }
        }

        private static byte[] Bits(AgingResult result)
        {
            var bits = new List<byte>();
            bits.AddRange(result.Height.ToArray());
            bits.AddRange(result.Normals.ToArray());
            bits.AddRange(result.LossAge.ToArray());
            bits.AddRange(result.View.ToArray());
            foreach (var point in result.Hair.ToArray<Point3>("position"))
            {
                bits.AddRange(BitConverter.GetBytes(point.X));
                bits.AddRange(BitConverter.GetBytes(point.Y));
                bits.AddRange(BitConverter.GetBytes(point.Z));
            }
            return bits.ToArray();
        }

        private static void Progress()
        {
            foreach (var outputs in new[] { AgingOutputs.All, AgingOutputs.Hair })
            {
                var thread = Thread.CurrentThread.ManagedThreadId;
                var reporter = new Reporter(
                    part => Assert.Equal(thread, Thread.CurrentThread.ManagedThreadId));
                using (var engine = Ball.Engine())
                {
                    AgingSim.Run(engine, Ball.Mesh(), Ball.Small(outputs), reporter).Dispose();
                }
                var heard = reporter.Heard;
                Assert.Equal(1.0, heard[heard.Count - 1]);
                for (var i = 0; i < heard.Count; i++)
                {
                    var before = i == 0 ? 0 : heard[i - 1];
                    Assert.True(heard[i] >= before && heard[i] <= 1, "progress never falls");
                }
            }
        }

        private static void Throwing()
        {
            using (var engine = Ball.Engine())
            {
                var reporter = new Reporter(part => { throw new DivideByZeroException("mine"); });
                var error = Assert.Throws<DivideByZeroException>(() => AgingSim.Run(
                    engine, Ball.Mesh(), Ball.Small(AgingOutputs.All), reporter));
                Assert.Equal("mine", error.Message);
            }
        }

        private static void Cancelling()
        {
            using (var engine = Ball.Engine(disableCache: true))
            using (var source = new CancellationTokenSource())
            {
                var reporter = new Reporter(part => source.Cancel());
                var error = Assert.Throws<OperationCanceledException>(() => AgingSim.Run(
                    engine, Ball.Mesh(), Ball.Small(AgingOutputs.All), reporter, source.Token));
                Assert.Equal(source.Token, error.CancellationToken);
                Assert.True(reporter.Heard.Last() < 1, "it did not go on");
                AgingSim.Run(engine, Ball.Mesh(), Ball.Small(AgingOutputs.Height)).Dispose();
            }
        }

        private static void Cancelled()
        {
            using (var engine = Ball.Engine())
            {
                var token = new CancellationToken(true);
                var settings = Ball.Small(AgingOutputs.All);
                Assert.Throws<OperationCanceledException>(
                    () => AgingSim.Run(engine, Ball.Mesh(), settings, null, token));
                var task = AgingSim.RunAsync(engine, Ball.Mesh(), settings, null, token);
                Assert.Throws<AggregateException>(() => task.Wait());
                Assert.True(task.IsCanceled, "a cancelled task");
            }
        }

        private static void Async()
        {
            var settings = Ball.Small(AgingOutputs.All);
            var wanted = Ball.With(settings, Bits);
            using (var engine = Ball.Engine())
            {
                var tasks = new List<Task<AgingResult>>();
                for (var i = 0; i < 4; i++)
                {
                    var mesh = Ball.Mesh();
                    tasks.Add(AgingSim.RunAsync(engine, mesh, settings, new Reporter()));
                    // The task has copies.
                    mesh.Vertices[0].Position.X = float.NaN;
                    mesh.Indices[0] = uint.MaxValue;
                }
                settings.Age = 2;
                settings.Outputs = AgingOutputs.None;
                Task.WaitAll(tasks.ToArray());
                foreach (var task in tasks)
                {
                    Assert.Same(wanted, Bits(task.Result));
                    task.Result.Dispose();
                }
            }
        }

        private static void WithoutPlugin()
        {
            using (var engine = new Engine())
            {
                var error = Assert.Fails(
                    Status.NotFound, () => AgingSim.Run(engine, Ball.Mesh()));
                Assert.Contains("LoadPlugin", error.Message);
            }
        }
    }
}
