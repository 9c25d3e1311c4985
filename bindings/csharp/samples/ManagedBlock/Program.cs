using System;
using PtLib;
using PtLib.Blocks;

namespace ManagedBlockSample
{
    /// <summary>
    /// A block type written in C#: checks, warped by noise that comes from the engine.
    /// </summary>
    internal static class Program
    {
        private static void Main()
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                engine.Register(new ManagedPlugin("sample", "1.0.0", "MIT", new Checks()));
                graph.SetSize(256, 256);
                graph.Precision = Precision.Float;
                var noise = graph.Add("perlin noise");
                var checks = graph.Add("sample.checks").Set("number", 6).Set("warp", 0.4);
                graph.Connect(noise, checks);
                using (var image = graph.Compute(checks))
                {
                    image.Save("ManagedBlock.png");
                    Console.WriteLine("ManagedBlock.png");
                }
            }
        }
    }
}
