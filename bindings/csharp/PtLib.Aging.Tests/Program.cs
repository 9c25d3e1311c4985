using System.Globalization;
using System.Threading;
using PtLib.Tests;

namespace PtLib.Aging.Tests
{
    /// <summary>
    /// The tests of the client that ages heads: a program, as those of the binding are. Its last
    /// line is "N passed, N failed". An argument picks the tests whose names contain it.
    /// </summary>
    internal static class Program
    {
        private static int Main(string[] arguments)
        {
            // Decimal commas: they must change nothing.
            Thread.CurrentThread.CurrentCulture = new CultureInfo("cs-CZ");
            var runner = new Runner(arguments.Length > 0 ? arguments[0] : string.Empty);
            MeshTests.Run(runner);
            SettingsTests.Run(runner);
            ResultTests.Run(runner);
            RunTests.Run(runner);
            GraphTests.Run(runner);
            runner.Summary();
            return runner.Failed == 0 ? 0 : 1;
        }
    }
}
