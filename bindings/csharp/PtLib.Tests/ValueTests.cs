using System;
using System.Runtime.CompilerServices;

namespace PtLib.Tests
{
    /// <summary>Managed structs across the border, there and back.</summary>
    internal static class ValueTests
    {
        private static readonly VertexPTN[] Corners =
        {
            Vertex(0, 0), Vertex(1, 0), Vertex(1, 1), Vertex(0, 1),
        };

        private static readonly uint[] Square = { 0, 1, 2, 0, 2, 3 };

        internal static void Run(Runner runner)
        {
            runner.Run("values: a mesh of vertices", MeshRoundTrip);
            runner.Run("values: a mesh that is lent", Lent);
            runner.Run("values: wrong meshes", WrongMeshes);
            runner.Run("values: points and strands", PointsAndStrands);
            runner.Run("values: a text", Texts);
            runner.Run("values: a colour transition", Gradients);
            runner.Run("values: pixels", Pixels);
            runner.Run("values: points of a Voronoi diagram", Voronoi);
        }

        private static VertexPTN Vertex(float x, float y)
        {
            return new VertexPTN(new Point3(x, y, 0), new Point2(x, y), new Point3(0, 0, 1));
        }

        /// <summary>What a value becomes on its way through an input of a graph.</summary>
        private static Value Through(Value value, string input)
        {
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                graph.SetSize(8, 8);
                var block = graph.Add(input).Set("name", "mine");
                graph.SetInput("mine", value);
                return graph.ComputeValue(block);
            }
        }

        private static void MeshRoundTrip()
        {
            using (var mesh = Mesh.FromVertices(Corners, Square, VertexPTN.Streams))
            using (var back = (Mesh)Through(mesh, "mesh input"))
            {
                Assert.Equal(ValueKind.Mesh, back.Kind);
                Assert.Equal(4, back.VertexCount);
                Assert.Equal(2, back.TriangleCount);
                Assert.Same(Square, back.IndicesToArray());
                var positions = back.ToArray<Point3>("position");
                Assert.Equal(1f, positions[2].X);
                Assert.Equal(1f, positions[2].Y);
                Assert.Equal(1f, back.ToArray<Point2>("texcoord")[1].X);
                Assert.Fails(Status.NotFound, () => back.ToArray<Point3>("tangent"));
                Assert.Fails(Status.TypeMismatch, () => back.ToArray<Point2>("normal"));
#if NET8_0_OR_GREATER
                Assert.Equal(2u, back.Indices[2]);
                Assert.Equal(1f, back.AsSpan<Point3>("normal")[3].Z);
#endif
            }
        }

        private static void Lent()
        {
            var dead = LendAndForget();
            for (var i = 0; i < 50 && dead.IsAlive; i++)
            {
                GC.Collect();
                GC.WaitForPendingFinalizers();
            }
            // mono searches stacks conservatively: there an array may look alive.
            if (Type.GetType("Mono.Runtime") == null)
            {
                Assert.True(!dead.IsAlive, "the loan ended");
            }
            var vertices = (VertexPTN[])Corners.Clone();
            Assert.Fails(
                Status.OutOfRange,
                () => Mesh.Lend(vertices, new uint[] { 0, 1, 9 }, VertexPTN.Streams));
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static WeakReference LendAndForget()
        {
            var vertices = (VertexPTN[])Corners.Clone();
            using (var mesh = Mesh.Lend(vertices, Square, VertexPTN.Streams))
            using (var back = (Mesh)Through(mesh, "mesh input"))
            {
                Assert.Equal(4, back.VertexCount);
                Assert.Equal(1f, back.ToArray<Point3>("position")[1].X);
            }
            return new WeakReference(vertices);
        }

        private static void WrongMeshes()
        {
            var streams = VertexPTN.Streams;
            var error = Assert.Fails(
                Status.OutOfRange,
                () => Mesh.FromVertices(Corners, new uint[] { 0, 1, 2, 0, 2, 77 }, streams));
            Assert.Contains("index 5", error.Message);
            Assert.Contains("77", error.Message);
            var broken = (VertexPTN[])Corners.Clone();
            broken[2].Position.Y = float.NaN;
            error = Assert.Fails(
                Status.OutOfRange, () => Mesh.FromVertices(broken, Square, streams));
            Assert.Contains("2", error.Message);
            error = Assert.Fails(
                Status.InvalidArgument,
                () => Mesh.FromVertices<VertexPTN>(null, Square, streams));
            Assert.Equal("vertices", error.Parameter);
            error = Assert.Fails(
                Status.InvalidArgument, () => Mesh.FromVertices(Corners, null, streams));
            Assert.Equal("indices", error.Parameter);
            Assert.Throws<PtLibException>(
                () => Mesh.FromVertices(Corners, new uint[] { 0, 1 }, streams));
            error = Assert.Fails(
                Status.OutOfRange,
                () => Mesh.FromVertices(
                    Corners, Square, VertexStream.Float("position", 3, 24)));
            Assert.Contains("32 bytes", error.Message);
            Assert.Throws<ArgumentException>(
                () => Mesh.FromVertices(new WithText[1], Square, streams));
        }

        private static void PointsAndStrands()
        {
            var points = new[] { new Point3(0, 0, 0), new Point3(1, 2, 3), new Point3(4, 5, 6) };
            var position = VertexStream.Float("position", 3, 0);
            using (var value = Points.FromElements(points, position))
            using (var back = (Points)Through(value, "points input"))
            {
                Assert.Equal(3, back.Count);
                Assert.Same(points, back.ToArray<Point3>("position"));
                Assert.Equal("position", back.StreamIds[0]);
            }
            var first = new uint[] { 0, 3 };
            using (var value = Strands.FromPoints(points, first, position))
            using (var back = (Strands)Through(value, "strands input"))
            {
                Assert.Equal(1, back.Count);
                Assert.Equal(3, back.PointCount);
                Assert.Same(first, back.FirstPointToArray());
                Assert.Same(points, back.ToArray<Point3>("position"));
            }
            Assert.Throws<PtLibException>(
                () => Strands.FromPoints(points, new uint[] { 0, 2 }, position));
            Assert.Throws<PtLibException>(
                () => Strands.FromPoints(points, new uint[0], position));
            points[1].Z = float.PositiveInfinity;
            var error = Assert.Fails(
                Status.OutOfRange, () => Points.FromElements(points, position));
            Assert.Contains("1", error.Message);
        }

        private static void Texts()
        {
            using (var value = Text.FromString("F+F−ř"))
            using (var back = Through(value, "text input"))
            {
                Assert.Equal("F+F−ř", back.ToString());
            }
            using (var value = Text.FromString("F"))
            {
                Assert.Fails(Status.TypeMismatch, () => Through(value, "mesh input"));
            }
        }

        private static void Gradients()
        {
            var stops = new[]
            {
                new GradientStop(0.25f, 1, 0, 0), new GradientStop(0.75f, 0, 0.5f, 1),
            };
            using (var value = Gradient.FromStops(stops[1], stops[0]))
            using (var back = (Gradient)Through(value, "gradient input"))
            {
                Assert.Same(stops, back.ToArray());
            }
            stops[1].Green = float.NaN;
            var error = Assert.Fails(Status.OutOfRange, () => Gradient.FromStops(stops));
            Assert.Contains("1", error.Message);
            Assert.Fails(Status.InvalidArgument, () => Gradient.FromStops(null));
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                var block = graph.Add("color transition");
                error = Assert.Fails(Status.OutOfRange, () => block.Set("data", stops));
                Assert.Contains("[1].Green", error.Message);
                stops[1].Green = 0.5f;
                block.Set("data", stops);
                Assert.Equal("64 255 0 0;191 0 128 255;", block.GetText("data"));
            }
        }

        private static void Pixels()
        {
            var pixels = new byte[8 * 8];
            pixels[9] = 200;
            using (var value = ImageValue.FromPixels(pixels, 8, 8, PixelFormat.Grey8))
            using (var back = (ImageValue)Through(value, "image input"))
            using (var image = back.ToImage(PixelFormat.Grey8))
            {
                Assert.Same(pixels, image.ToArray());
            }
            var floats = new float[8 * 8 * 3];
            floats[4] = 0.5f;
            using (var value = ImageValue.FromPixels(floats, 8, 8, PixelFormat.RgbFloat))
            using (var image = value.ToImage())
            {
                Assert.Same(floats, image.ToFloatArray());
            }
            floats[5] = float.NaN;
            var error = Assert.Fails(
                Status.OutOfRange,
                () => ImageValue.FromPixels(floats, 8, 8, PixelFormat.RgbFloat));
            error = Assert.Fails(
                Status.InvalidArgument,
                () => ImageValue.FromPixels(pixels, 8, 9, PixelFormat.Grey8));
            Assert.Contains("need 72", error.Message);
            Assert.Fails(
                Status.InvalidArgument,
                () => ImageValue.FromPixels<byte>(null, 8, 8, PixelFormat.Grey8));
        }

        private static void Voronoi()
        {
            var points = new[]
            {
                new Point2(0.1f, 0.25f), new Point2(0.000001f, 0.5f), new Point2(1, 0.75f),
            };
            using (var engine = new Engine())
            using (var graph = engine.CreateGraph())
            {
                graph.SetSize(16, 16);
                var cells = graph.Add("voronoi diagram").Set("point place", "custom");
                cells.Set("point positions", points);
                Assert.True(
                    cells.GetText("point positions").EndsWith(",1:0.75", StringComparison.Ordinal),
                    "decimal points");
                graph.Compute(cells).Dispose();
                points[1].X = float.NaN;
                var error = Assert.Fails(
                    Status.OutOfRange, () => cells.Set("point positions", points));
                Assert.Contains("points[1].X", error.Message);
                Assert.Fails(
                    Status.InvalidArgument, () => cells.Set("point positions", default(Point2[])));
            }
        }

        private struct WithText
        {
#pragma warning disable 649, 169 // Only its layout matters.
            public string Text;
#pragma warning restore 649, 169
        }
    }
}
