using System;
using System.Collections.Generic;
using System.Threading;
using System.Threading.Tasks;

namespace PtLib.Tests
{
    /// <summary>Progress, cancelling, the log.</summary>
    internal static class CallbackTests
    {
        private static readonly ComputeOptions Large = new ComputeOptions
        {
            Width = 2048,
            Height = 2048,
            ProgressInterval = TimeSpan.FromMilliseconds(1),
        };

        internal static void Run(Runner runner)
        {
            runner.Run("callbacks: progress rises to one on the calling thread", Progress);
            runner.Run("callbacks: an exception in the progress comes out", Throwing);
            runner.Run("callbacks: a token cancels", Cancelling);
            runner.Run("callbacks: a token that is cancelled already", Cancelled);
            runner.Run("callbacks: from several tasks at once", Tasks);
            runner.Run("callbacks: the log", Log);
            runner.Run("callbacks: a search for plug-ins", Scan);
        }

        private static void With(Action<Graph, Block> action)
        {
            using (var engine = new Engine(new EngineOptions { DisableCache = true }))
            using (var graph = engine.CreateGraph())
            {
                action(graph, GraphTests.Build(graph));
            }
        }

        private static void Progress()
        {
            With((graph, end) =>
            {
                var reports = new List<double>();
                var thread = Thread.CurrentThread.ManagedThreadId;
                var progress = new Reporter(fraction =>
                {
                    Assert.Equal(thread, Thread.CurrentThread.ManagedThreadId);
                    reports.Add(fraction);
                });
                graph.Compute(end, Large, progress).Dispose();
                Assert.Equal(1.0, reports[reports.Count - 1]);
                for (var i = 1; i < reports.Count; i++)
                {
                    Assert.True(reports[i] >= reports[i - 1], "progress never falls");
                }
            });
        }

        private static void Throwing()
        {
            With((graph, end) =>
            {
                var progress = new Reporter(fraction =>
                {
                    throw new DivideByZeroException("mine");
                });
                var error = Assert.Throws<DivideByZeroException>(
                    () => graph.Compute(end, Large, progress));
                Assert.Equal("mine", error.Message);
                graph.Compute(end).Dispose();
            });
        }

        private static void Cancelling()
        {
            With((graph, end) =>
            {
                using (var source = new CancellationTokenSource())
                {
                    var progress = new Reporter(fraction => source.Cancel());
                    var error = Assert.Throws<OperationCanceledException>(
                        () => graph.Compute(end, Large, progress, source.Token));
                    Assert.Equal(source.Token, error.CancellationToken);
                }
            });
        }

        private static void Cancelled()
        {
            With((graph, end) =>
            {
                var token = new CancellationToken(true);
                Assert.Throws<OperationCanceledException>(
                    () => graph.Compute(end, null, null, token));
                var task = graph.ComputeAsync(end, null, null, token);
                Assert.Throws<AggregateException>(() => task.Wait());
                Assert.True(task.IsCanceled, "a cancelled task");
            });
        }

        private static void Tasks()
        {
            With((graph, end) =>
            {
                var calls = 0;
                var tasks = new List<Task<Image>>();
                for (var i = 0; i < 8; i++)
                {
                    var progress = new Reporter(fraction => Interlocked.Increment(ref calls));
                    tasks.Add(graph.ComputeAsync(end, null, progress));
                }
                // The tasks have their own copies.
                graph.Remove(end);
                Task.WaitAll(tasks.ToArray());
                foreach (var task in tasks)
                {
                    Assert.Same(tasks[0].Result.ToArray(), task.Result.ToArray());
                }
                tasks.ForEach(task => task.Result.Dispose());
                Assert.True(calls >= 8, "each was told");
            });
        }

        private static void Log()
        {
            var lines = new List<string>();
            using (var engine = new Engine())
            {
                engine.SetLog(LogLevel.Debug, (level, message) =>
                {
                    lock (lines)
                    {
                        lines.Add(message);
                    }
                    throw new InvalidOperationException("dropped");
                });
                const string file =
                    "<!DOCTYPE ptgraph>\n<texturegraph height=\"64\" seed=\"7\"></texturegraph>";
                using (var graph = engine.LoadGraph(System.Text.Encoding.UTF8.GetBytes(file)))
                {
                    Assert.True(graph.Warnings.Count > 0, "a warning");
                }
                Assert.True(lines.Count > 0, "a line in the log");
                engine.SetLog(LogLevel.Debug, null);
            }
        }

        private static void Scan()
        {
            using (var engine = new Engine())
            {
                var found = engine.ScanPlugins("/no/such/folder");
                Assert.Equal(0, found.Count);
            }
        }

        /// <summary>Calls back at once, on the thread that reports.</summary>
        private sealed class Reporter : IProgress<double>
        {
            private readonly Action<double> action;

            internal Reporter(Action<double> action)
            {
                this.action = action;
            }

            public void Report(double value)
            {
                action(value);
            }
        }
    }
}
