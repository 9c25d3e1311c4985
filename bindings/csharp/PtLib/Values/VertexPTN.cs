using System.Runtime.InteropServices;

namespace PtLib
{
    /// <summary>A vertex of eight floats: position, texture coordinates, normal.</summary>
    [StructLayout(LayoutKind.Sequential, Pack = 4)]
    public struct VertexPTN
    {
        /// <summary>The position.</summary>
        public Point3 Position;

        /// <summary>The texture coordinates.</summary>
        public Point2 TexCoord;

        /// <summary>The normal; any length but 0.</summary>
        public Point3 Normal;

        /// <summary>Makes a vertex.</summary>
        /// <param name="position">The position.</param>
        /// <param name="texCoord">The texture coordinates.</param>
        /// <param name="normal">The normal.</param>
        public VertexPTN(Point3 position, Point2 texCoord, Point3 normal)
        {
            Position = position;
            TexCoord = texCoord;
            Normal = normal;
        }

        /// <summary>Its streams, for <see cref="Mesh.FromVertices{T}"/>.</summary>
        public static VertexStream[] Streams
        {
            get
            {
                return new[]
                {
                    VertexStream.Float("position", 3, 0),
                    VertexStream.Float("texcoord", 2, 12),
                    VertexStream.Float("normal", 3, 20),
                };
            }
        }
    }
}
