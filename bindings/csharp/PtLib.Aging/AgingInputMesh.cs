using System;
using System.Diagnostics.CodeAnalysis;

namespace PtLib.Aging
{
    /// <summary>
    /// A head: triangles whose vertices have a position, texture coordinates and a normal. The
    /// second texture coordinate points up, as y does; the face looks along z.
    /// </summary>
    public sealed class AgingInputMesh
    {
        /// <summary>An empty mesh, to be filled.</summary>
        public AgingInputMesh()
        {
        }

        /// <summary>A mesh of arrays, which it keeps.</summary>
        /// <param name="vertices">The vertices.</param>
        /// <param name="indices">Numbers of vertices, three for each triangle.</param>
        public AgingInputMesh(VertexPTN[] vertices, uint[] indices)
        {
            Vertices = vertices;
            Indices = indices;
        }

        /// <summary>The vertices.</summary>
        [AllowNull]
        [MaybeNull]
        public VertexPTN[] Vertices { get; set; }

        /// <summary>Numbers of vertices, three for each triangle.</summary>
        [AllowNull]
        [MaybeNull]
        public uint[] Indices { get; set; }

        /// <summary>Copies and checks the mesh, for the input "head" of a graph.</summary>
        /// <returns>The mesh; dispose of it.</returns>
        /// <exception cref="PtLibException">An array is null or empty, an index is no number of a
        /// vertex, a number is not finite: the message names the first wrong one and how many
        /// there are.</exception>
        public Mesh ToMesh()
        {
            return Mesh.FromVertices(
                Filled(Vertices, nameof(Vertices)),
                Filled(Indices, nameof(Indices)),
                VertexPTN.Streams);
        }

        private static T[] Filled<T>([AllowNull] T[] array, string name)
        {
            if (array == null || array.Length == 0)
            {
                throw new PtLibException(
                    Status.InvalidArgument,
                    "mesh: " + name + " is " + (array == null ? "null" : "empty") +
                    ", one triangle is needed at least.",
                    name);
            }
            return array;
        }
    }
}
