using System;
using System.Diagnostics;
using System.Globalization;
using System.IO;
using System.Threading;
using PtLib;
using PtLib.Aging;

namespace AgingClient
{
    /// <summary>
    /// Ages a head from 0 to 1 in ten steps, and saves its pictures and its hair. The head is made
    /// here, as a modelling program would give it: an array of vertices and one of indices. Ctrl-C
    /// cancels. The argument is the file of the plug-in "aging"; without it the variable
    /// PTLIB_AGING_PLUGIN names it.
    /// </summary>
    internal static class Program
    {
        private const int Steps = 10;

        private static int Main(string[] arguments)
        {
            var plugin = arguments.Length > 0
                ? arguments[0]
                : Environment.GetEnvironmentVariable("PTLIB_AGING_PLUGIN");
            if (string.IsNullOrEmpty(plugin))
            {
                Console.Error.WriteLine("usage: AgingClient PLUGIN (…/aging.ptplugin.so)");
                return 2;
            }
            using (var cancel = new CancellationTokenSource())
            {
                Console.CancelKeyPress += (sender, pressed) =>
                {
                    // The computation ends, and then the program.
                    pressed.Cancel = true;
                    cancel.Cancel();
                };
                try
                {
                    Age(plugin, Directory.GetCurrentDirectory(), cancel.Token);
                    return 0;
                }
                catch (OperationCanceledException)
                {
                    Console.WriteLine("\ncancelled");
                    return 1;
                }
                catch (PtLibException error)
                {
                    Console.Error.WriteLine("\n" + error.Status + ": " + error.Message);
                    return 1;
                }
            }
        }

        private static void Age(string plugin, string folder, CancellationToken cancel)
        {
            var options = new EngineOptions();
            options.WriteFolders.Add(folder);
            using (var engine = new Engine(options))
            {
                engine.LoadPlugin(plugin);
                var mesh = Head.Make(96, 64);
                var settings = new AgingSettings
                {
                    Size = 512,
                    Hairs = 40000,
                    Outputs = AgingOutputs.View | AgingOutputs.Hair,
                };
                for (var step = 0; step <= Steps; step++)
                {
                    settings.Age = step / (double)Steps;
                    var watch = Stopwatch.StartNew();
                    using (var result = AgingSim.Run(engine, mesh, settings, new Bar(), cancel))
                    {
                        Save(engine, result, Path.Combine(folder, Name(step)));
                        Console.WriteLine(string.Format(
                            CultureInfo.InvariantCulture,
                            "\rage {0:0.0}: {1} hairs of {2}, {3} ms",
                            settings.Age, result.Hair.Count, result.HairsAt(0),
                            watch.ElapsedMilliseconds));
                    }
                }
            }
        }

        private static string Name(int step)
        {
            return "AgingClient-" + step.ToString("00", CultureInfo.InvariantCulture);
        }

        /// <summary>Saves the picture as PNG, and the hair as PLY.</summary>
        private static void Save(Engine engine, AgingResult result, string path)
        {
            result.View.Save(path + ".png");
            using (var graph = engine.CreateGraph())
            {
                var hair = graph.Add("strands input");
                var save = graph.Add("aging.save strands").Set("path", path + ".ply");
                graph.Connect(hair, save, input: 1);
                graph.SetInput(hair, result.Hair);
                graph.ComputeValue(save).Dispose();
            }
        }

        private sealed class Bar : IProgress<double>
        {
            public void Report(double value)
            {
                Console.Write("\r" + (int)(value * 100) + " %");
            }
        }
    }
}
