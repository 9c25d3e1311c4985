using System;
using System.Diagnostics.CodeAnalysis;
using System.Threading;

namespace PtLib.Aging
{
    /// <summary>Computes those outputs that are asked for, one after the other; together they have
    /// one progress.</summary>
    internal sealed class Computation
    {
        private readonly Graph graph;
        private readonly AgingOutputs asked;
        private readonly CancellationToken cancel;

        [AllowNull]
        [MaybeNull]
        private readonly Steps steps;

        internal Computation(
            Graph graph,
            AgingOutputs asked,
            [AllowNull] IProgress<double> progress,
            CancellationToken cancel)
        {
            this.graph = graph;
            this.asked = asked;
            this.cancel = cancel;
            if (progress != null)
            {
                steps = new Steps(progress, Count(asked));
            }
        }

        /// <summary>An image; null if it is not asked for.</summary>
        [return: MaybeNull]
        internal Image Image(AgingOutputs output, string block, PixelFormat format)
        {
            if ((asked & output) == 0)
            {
                return null;
            }
            var options = new ComputeOptions { Format = format };
            var image = graph.Compute(AgingSim.Named(graph, block), options, steps, cancel);
            Next();
            return image;
        }

        /// <summary>A value; null if it is not asked for.</summary>
        [return: MaybeNull]
        internal Value Value(AgingOutputs output, string block)
        {
            if ((asked & output) == 0)
            {
                return null;
            }
            var value = graph.ComputeValue(AgingSim.Named(graph, block), null, steps, cancel);
            Next();
            return value;
        }

        /// <summary>How many computations there are: hair takes two.</summary>
        private static int Count(AgingOutputs asked)
        {
            var count = (asked & AgingOutputs.Hair) != 0 ? 1 : 0;
            for (var bits = (int)(asked & AgingOutputs.All); bits != 0; bits &= bits - 1)
            {
                count++;
            }
            return count;
        }

        private void Next()
        {
            if (steps != null)
            {
                steps.Next();
            }
        }

        private sealed class Steps : IProgress<double>
        {
            private readonly IProgress<double> whole;
            private readonly int count;
            private int done;

            internal Steps(IProgress<double> whole, int count)
            {
                this.whole = whole;
                this.count = count;
            }

            public void Report(double value)
            {
                whole.Report((done + value) / count);
            }

            internal void Next()
            {
                done++;
            }
        }
    }
}
