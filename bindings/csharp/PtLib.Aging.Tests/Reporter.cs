using System;
using System.Collections.Generic;

namespace PtLib.Aging.Tests
{
    /// <summary>Keeps what is reported, and calls back at once, on the thread that reports.
    /// </summary>
    internal sealed class Reporter : IProgress<double>
    {
        private readonly Action<double> action;

        internal Reporter(Action<double> action = null)
        {
            this.action = action;
        }

        internal List<double> Heard { get; } = new List<double>();

        public void Report(double value)
        {
            lock (Heard)
            {
                Heard.Add(value);
            }
            if (action != null)
            {
                action(value);
            }
        }
    }
}
