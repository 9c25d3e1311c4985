using System;
using System.Runtime.InteropServices;
using PtLib.Tests;

namespace PtLib.Aging.Tests
{
    /// <summary>Meshes of callers. A wrong one is refused before anything is computed.</summary>
    internal static class MeshTests
    {
        internal static void Run(Runner runner)
        {
            runner.Run("mesh: a vertex has 32 bytes", Layout);
            runner.Run("mesh: it reaches the library as it is", Arrives);
            runner.Run("mesh: null or empty", Missing);
            runner.Run("mesh: indices out of range", Indices);
            runner.Run("mesh: numbers that are not finite", NotFinite);
        }

        private static void Layout()
        {
            Assert.Equal(32, Marshal.SizeOf(typeof(VertexPTN)));
            Assert.Equal(12, (int)Marshal.OffsetOf(typeof(VertexPTN), "TexCoord"));
            Assert.Equal(20, (int)Marshal.OffsetOf(typeof(VertexPTN), "Normal"));
        }

        private static void Arrives()
        {
            var mesh = Ball.Mesh();
            using (var value = mesh.ToMesh())
            {
                Assert.Equal(mesh.Vertices.Length, value.VertexCount);
                Assert.Same(mesh.Indices, value.IndicesToArray());
                Assert.Equal(
                    mesh.Vertices[30].Position, value.ToArray<Point3>("position")[30]);
                Assert.Equal(
                    mesh.Vertices[30].TexCoord, value.ToArray<Point2>("texcoord")[30]);
            }
        }

        private static void Missing()
        {
            Refused(Status.InvalidArgument, "Vertices is null", mesh => mesh.Vertices = null);
            Refused(Status.InvalidArgument, "Indices is null", mesh => mesh.Indices = null);
            Refused(
                Status.InvalidArgument, "Vertices is empty",
                mesh => mesh.Vertices = new VertexPTN[0]);
            Refused(
                Status.InvalidArgument, "Indices is empty", mesh => mesh.Indices = new uint[0]);
            using (var engine = Ball.Engine())
            {
                Assert.Throws<ArgumentNullException>(() => AgingSim.Run(engine, null));
                Assert.Throws<ArgumentNullException>(() => AgingSim.Run(null, Ball.Mesh()));
            }
        }

        private static void Indices()
        {
            var count = (uint)Ball.Mesh().Vertices.Length;
            Refused(Status.OutOfRange, "7", mesh => mesh.Indices[7] = count);
            Refused(Status.OutOfRange, "9", mesh => mesh.Indices[9] = uint.MaxValue);
            Refused(
                Status.InvalidArgument, "3", mesh => mesh.Indices = new uint[] { 0, 1, 2, 3 });
        }

        private static void NotFinite()
        {
            foreach (var wrong in new[] { float.NaN, float.PositiveInfinity, -float.MaxValue })
            {
                Refused(Status.OutOfRange, "31", mesh => mesh.Vertices[31].Position.Y = wrong);
                Refused(Status.OutOfRange, "32", mesh => mesh.Vertices[32].TexCoord.X = wrong);
                Refused(Status.OutOfRange, "33", mesh => mesh.Vertices[33].Normal.Z = wrong);
            }
        }

        /// <summary>Spoils a mesh, and checks what is said of it and that nothing was computed.
        /// </summary>
        private static void Refused(Status status, string part, Action<AgingInputMesh> spoil)
        {
            var mesh = Ball.Mesh();
            spoil(mesh);
            var reporter = new Reporter();
            var settings = Ball.Small(AgingOutputs.Height);
            using (var engine = Ball.Engine())
            {
                var error = Assert.Fails(
                    status, () => AgingSim.Run(engine, mesh, settings, reporter));
                Assert.Contains(part, error.Message);
                Assert.Fails(status, () => AgingSim.RunAsync(engine, mesh, settings, reporter));
            }
            Assert.Equal(0, reporter.Heard.Count);
        }
    }
}
