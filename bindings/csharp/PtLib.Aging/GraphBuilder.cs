using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.IO;
using System.Text;

namespace PtLib.Aging
{
    /// <summary>
    /// Makes the graph. Names of blocks are ids of a graph's file, so it starts as such a file:
    /// blocks and connections. Everything else is set as on any graph.
    /// </summary>
    internal sealed class GraphBuilder
    {
        private readonly AgingSettings settings;
        private readonly StringBuilder file = new StringBuilder();
        private readonly List<KeyValuePair<string, ImageSource>> pictures =
            new List<KeyValuePair<string, ImageSource>>();

        private GraphBuilder(AgingSettings settings)
        {
            this.settings = settings;
        }

        internal static Graph Build(Engine engine, AgingSettings settings)
        {
            if (engine.FindBlockType("aging.head view") == null)
            {
                throw new PtLibException(
                    Status.NotFound,
                    "The engine has no block \"aging.head view\"; load the plug-in \"aging\" " +
                    "first: engine.LoadPlugin(\"…/aging.ptplugin.so\").",
                    nameof(engine));
            }
            return new GraphBuilder(settings).Build(engine);
        }

        private Graph Build(Engine engine)
        {
            file.Append(
                "<!DOCTYPE ptgraph>\n<texturegraph width=\"1024\" height=\"1024\" seed=\"0\" " +
                "supersampling=\"1\" version=\"1\" precision=\"float\">\n");
            Skin();
            Hair();
            Block("aging.head view", "view", "frames", Picture("skin color", settings.SkinColor),
                "normals", "", "", "hair");
            file.Append("</texturegraph>\n");
            var graph = engine.LoadGraph(Encoding.UTF8.GetBytes(file.ToString()));
            try
            {
                Set(graph);
                return graph;
            }
            catch
            {
                graph.Dispose();
                throw;
            }
        }

        private void Skin()
        {
            Block("aging.mesh input", "head");
            Block("aging.mesh frames", "frames", "head");
            Block("aging.wrinkle map", "wrinkles");
            var mask = Picture("wrinkle mask", settings.WrinkleMask);
            Block("aging.age height", "height", "wrinkles", mask);
            var tile = Picture("fine tile", settings.FineTile);
            if (tile.Length == 0)
            {
                Block("aging.height to normal", "normals", "height");
                return;
            }
            Block("aging.height to normal", "wrinkle normals", "height");
            Block("aging.fine wrinkles", "fine heights", tile);
            Block("aging.height to normal", "fine normals", "fine heights");
            var fineMask = Picture("fine mask", settings.FineMask);
            Block("aging.blend normals", "normals", "wrinkle normals", "fine normals", fineMask);
        }

        private void Hair()
        {
            var outer = Picture("outer hair", settings.OuterHair ?? Regions.Outer());
            var inner = Picture("inner hair", settings.InnerHair ?? Regions.Inner());
            Block("aging.hair transition", "loss age", outer, inner);
            Block("aging.scatter hair", "roots", "frames", "loss age");
            Block("aging.hair at age", "living roots", "roots");
            Block("aging.grey hair", "colored roots", "living roots");
            Block("aging.grow strands", "hair", "colored roots");
        }

        /// <summary>Adds the block of a picture; returns its name, empty if there is none.
        /// </summary>
        private string Picture(string name, [AllowNull] ImageSource source)
        {
            if (source == null)
            {
                return string.Empty;
            }
            Block(source.File != null ? "load file" : "image input", name);
            pictures.Add(new KeyValuePair<string, ImageSource>(name, source));
            return name;
        }

        /// <summary>Adds a block and its connections: empty for an input without one.</summary>
        private void Block(string type, string name, params string[] inputs)
        {
            file.Append("<block type=\"" + type + "\" id=\"" + name + "\">");
            for (var i = 0; i < inputs.Length; i++)
            {
                if (inputs[i].Length != 0)
                {
                    file.Append("<input id=\"" + inputs[i] + "\" slot=\"" + i + "\"/>");
                }
            }
            file.Append("</block>\n");
        }

        private void Set(Graph graph)
        {
            graph.SetSize(settings.Size, settings.Size);
            graph.Seed = settings.Seed;
            AgingSim.SetAge(graph, settings.Age);
            AgingSim.Named(graph, "roots").Set("hairs", settings.Hairs);
            if (settings.Muscles != null)
            {
                AgingSim.Named(graph, "wrinkles").Set("muscles", settings.Muscles);
            }
            var folder = Folder();
            if (folder.Length != 0)
            {
                graph.SetFolder(folder);
            }
            foreach (var picture in pictures)
            {
                Set(AgingSim.Named(graph, picture.Key), picture, folder);
            }
        }

        private static void Set(
            Block block, KeyValuePair<string, ImageSource> picture, string folder)
        {
            var path = picture.Value.File;
            if (path != null)
            {
                // Relative: then a graph that is saved in that folder finds it too.
                var isBelow = IsBelow(path, folder);
                block.Set("path", isBelow ? path.Substring(WithEnd(folder).Length) : path);
                return;
            }
            block.Set("name", picture.Key);
            using (var value = picture.Value.ToValue())
            {
                block.Graph.SetInput(block, value);
            }
        }

        /// <summary>The deepest folder that all files are in; empty without files.</summary>
        private string Folder()
        {
            var common = string.Empty;
            foreach (var picture in pictures)
            {
                var folder = Path.GetDirectoryName(picture.Value.File) ?? string.Empty;
                while (folder.Length != 0 && common.Length != 0 && !IsBelow(folder, common))
                {
                    common = Path.GetDirectoryName(common) ?? string.Empty;
                }
                common = common.Length == 0 ? folder : common;
            }
            return common;
        }

        private static bool IsBelow(string path, string ancestor)
        {
            return WithEnd(path).StartsWith(WithEnd(ancestor), StringComparison.Ordinal);
        }

        private static string WithEnd(string folder)
        {
            var end = Path.DirectorySeparatorChar.ToString();
            return folder.EndsWith(end, StringComparison.Ordinal) ? folder : folder + end;
        }
    }
}
