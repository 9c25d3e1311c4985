using System;
using System.Diagnostics.CodeAnalysis;
using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// A block of a graph: a small value that may be copied. It stays invalid once the block was
    /// removed, also when another block takes its place.
    /// </summary>
    public readonly unsafe partial struct Block : IEquatable<Block>
    {
        [AllowNull, MaybeNull]
        private readonly Graph graph;

        internal Block(Graph graph, ulong handle)
        {
            this.graph = graph;
            Handle = handle;
        }

        /// <summary>The graph that it belongs to.</summary>
        /// <exception cref="InvalidOperationException">This is default(Block).</exception>
        public Graph Graph
        {
            get
            {
                return graph ?? throw new InvalidOperationException(
                    "This is no block of a graph, but the default value of its type.");
            }
        }

        /// <summary>Its number in the library; it is the same in clones of the graph.</summary>
        public ulong Handle { get; }

        /// <summary>Its type.</summary>
        /// <exception cref="PtLibException">Its type is unknown: its plug-in is missing.
        /// </exception>
        public BlockType Type
        {
            get
            {
                IntPtr type, error;
                using (var owner = Graph.Use())
                {
                    var status =
                        NativeMethods.ptl_graph_block_type(owner.Pointer, Handle, &type, &error);
                    Errors.Check(status, error);
                    return new BlockType(type);
                }
            }
        }

        /// <summary>The id of its type, also of an unknown type.</summary>
        public string TypeId
        {
            get
            {
                IntPtr bytes, error;
                using (var owner = Graph.Use())
                {
                    var status = NativeMethods.ptl_graph_block_type_id(
                        owner.Pointer, Handle, &bytes, &error);
                    Errors.Check(status, error);
                }
                return Utf8.Take(bytes);
            }
        }

        /// <summary>Its id in the graph's file.</summary>
        public string FileId
        {
            get
            {
                IntPtr bytes, error;
                using (var owner = Graph.Use())
                {
                    var status =
                        NativeMethods.ptl_graph_block_id(owner.Pointer, Handle, &bytes, &error);
                    Errors.Check(status, error);
                }
                return Utf8.Take(bytes);
            }
        }

        /// <summary>Its seed: its own, or that of the graph.</summary>
        public ulong Seed
        {
            get { return ReadSeed().Item1; }
        }

        /// <summary>Whether it has a seed of its own.</summary>
        public bool HasOwnSeed
        {
            get { return ReadSeed().Item2; }
        }

        /// <summary>Whether two blocks are the same.</summary>
        /// <param name="left">One.</param>
        /// <param name="right">The other.</param>
        /// <returns>Whether they are the same block of the same graph.</returns>
        public static bool operator ==(Block left, Block right)
        {
            return left.Equals(right);
        }

        /// <summary>Whether two blocks differ.</summary>
        /// <param name="left">One.</param>
        /// <param name="right">The other.</param>
        /// <returns>Whether they are not the same block of the same graph.</returns>
        public static bool operator !=(Block left, Block right)
        {
            return !left.Equals(right);
        }

        /// <summary>Gives it its own seed, or that of the graph again.</summary>
        /// <param name="seed">The seed; null: that of the graph.</param>
        public void SetSeed(ulong? seed)
        {
            IntPtr error;
            using (var owner = Graph.Use())
            {
                var status = seed.HasValue
                    ? NativeMethods.ptl_graph_set_block_seed(
                        owner.Pointer, Handle, seed.Value, &error)
                    : NativeMethods.ptl_graph_reset_block_seed(owner.Pointer, Handle, &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>Whether it is another one's twin.</summary>
        /// <param name="other">The other.</param>
        /// <returns>Whether they are the same block of the same graph.</returns>
        public bool Equals(Block other)
        {
            return ReferenceEquals(graph, other.graph) && Handle == other.Handle;
        }

        /// <summary>Whether it is another one's twin.</summary>
        /// <param name="obj">The other.</param>
        /// <returns>Whether they are the same block of the same graph.</returns>
        public override bool Equals([AllowNull] object obj)
        {
            return obj is Block && Equals((Block)obj);
        }

        /// <summary>A hash of what <see cref="Equals(Block)"/> compares.</summary>
        /// <returns>The hash.</returns>
        public override int GetHashCode()
        {
            return Handle.GetHashCode();
        }

        private Tuple<ulong, bool> ReadSeed()
        {
            IntPtr error;
            ulong seed = 0;
            var isOwn = 0;
            using (var owner = Graph.Use())
            {
                var status = NativeMethods.ptl_graph_get_block_seed(
                    owner.Pointer, Handle, &seed, &isOwn, &error);
                Errors.Check(status, error);
            }
            return Tuple.Create(seed, isOwn != 0);
        }
    }
}
