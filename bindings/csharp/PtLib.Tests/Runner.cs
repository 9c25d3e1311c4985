using System;
using System.Collections.Generic;
using System.Globalization;

namespace PtLib.Tests
{
    /// <summary>Runs tests one after the other and counts them.</summary>
    internal sealed class Runner
    {
        private readonly string filter;
        private int passed;
        private int failed;

        internal Runner(string filter)
        {
            this.filter = filter;
        }

        internal int Failed
        {
            get { return failed; }
        }

        internal void Run(string name, Action test)
        {
            if (!name.Contains(filter))
            {
                return;
            }
            try
            {
                test();
                passed++;
            }
            catch (Exception exception)
            {
                failed++;
                Console.WriteLine("FAILED " + name);
                Console.WriteLine("  " + exception);
            }
        }

        internal void Summary()
        {
            Console.WriteLine(string.Format(
                CultureInfo.InvariantCulture, "{0} passed, {1} failed", passed, failed));
        }
    }
}
