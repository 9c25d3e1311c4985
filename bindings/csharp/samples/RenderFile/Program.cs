using System;
using PtLib;

namespace RenderFile
{
    /// <summary>
    /// Renders a graph file as a picture: RenderFile GRAPH.xml PICTURE.png [SIZE]
    /// </summary>
    internal static class Program
    {
        private static int Main(string[] arguments)
        {
            if (arguments.Length < 2)
            {
                Console.Error.WriteLine("usage: RenderFile GRAPH.xml PICTURE.png [SIZE]");
                return 2;
            }
            var options = new ComputeOptions();
            if (arguments.Length > 2)
            {
                options.Width = options.Height = int.Parse(arguments[2]);
            }
            try
            {
                Render(arguments[0], arguments[1], options);
                return 0;
            }
            catch (PtLibException exception)
            {
                Console.Error.WriteLine(exception.Message);
                return 1;
            }
        }

        private static void Render(string file, string picture, ComputeOptions options)
        {
            using (var engine = new Engine())
            using (var graph = engine.LoadGraphFile(file))
            {
                foreach (var warning in graph.Warnings)
                {
                    Console.Error.WriteLine("warning: " + warning);
                }
                var result = graph.MainResult;
                if (!result.HasValue)
                {
                    throw new InvalidOperationException("The graph has no block of type \"end\".");
                }
                using (var image = graph.Compute(result.Value, options))
                {
                    image.Save(picture);
                    Console.WriteLine(picture + ": " + image.Width + " × " + image.Height);
                }
            }
        }
    }
}
