namespace PtLib
{
    /// <summary>
    /// What one part of a struct means: the data of a mesh, of points or of strands is an array of
    /// structs, and each part of the struct is a stream with an id.
    /// <para>
    /// Ids that the library knows: "position" (3 floats, mandatory), "normal", "direction" (3),
    /// "texcoord", "texcoord1" (2), "tangent" (4, the last +1 or -1), "color" (3 or 4, each 0 to
    /// 1), "radius", "random", "loss age" (1), "id" (2 whole numbers). Others pass through.
    /// </para>
    /// </summary>
    public sealed class VertexStream
    {
        private VertexStream(string id, int components, int offset, bool isFloat)
        {
            Id = id;
            Components = components;
            Offset = offset;
            IsFloat = isFloat;
        }

        /// <summary>Its id.</summary>
        public string Id { get; }

        /// <summary>Numbers of an element, 1 to 4.</summary>
        public int Components { get; }

        /// <summary>Where it begins in the struct, in bytes: a multiple of 4.</summary>
        public int Offset { get; }

        /// <summary>Whether its numbers are floats; else uint.</summary>
        public bool IsFloat { get; }

        /// <summary>A stream of floats.</summary>
        /// <param name="id">Its id.</param>
        /// <param name="components">Numbers of an element, 1 to 4.</param>
        /// <param name="offset">Where it begins in the struct, in bytes.</param>
        /// <returns>The stream.</returns>
        public static VertexStream Float(string id, int components, int offset)
        {
            return new VertexStream(id, components, offset, true);
        }

        /// <summary>A stream of whole numbers.</summary>
        /// <param name="id">Its id.</param>
        /// <param name="components">Numbers of an element, 1 to 4.</param>
        /// <param name="offset">Where it begins in the struct, in bytes.</param>
        /// <returns>The stream.</returns>
        public static VertexStream UInt32(string id, int components, int offset)
        {
            return new VertexStream(id, components, offset, false);
        }
    }
}
