using System;
using System.Globalization;
using System.Threading;

namespace PtLib.Tests
{
    /// <summary>
    /// The tests of the binding: a program, so that the same sources run under every runtime. Its
    /// last line is "N passed, N failed". An argument picks the tests whose names contain it;
    /// "--load" only loads the library, for tests that need a process of their own.
    /// </summary>
    internal static class Program
    {
        private static int Main(string[] arguments)
        {
            if (arguments.Length == 1 && arguments[0] == "--load")
            {
                return LoadingTests.LoadHere();
            }
            // Decimal commas: they must change nothing.
            Thread.CurrentThread.CurrentCulture = new CultureInfo("cs-CZ");
            var runner = new Runner(arguments.Length > 0 ? arguments[0] : string.Empty);
            AbiTests.Run(runner);
            LoadingTests.Run(runner);
            GraphTests.Run(runner);
            ComputeTests.Run(runner);
            CallbackTests.Run(runner);
            LifetimeTests.Run(runner);
            ValueTests.Run(runner);
            BlockTests.Run(runner);
            runner.Summary();
            return runner.Failed == 0 ? 0 : 1;
        }
    }
}
