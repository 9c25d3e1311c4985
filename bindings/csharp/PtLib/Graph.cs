using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.InteropServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// A texture: blocks and their connections. One thread at a time changes it; reading and
    /// computing may run on several threads at once, and on one that changes it: a computation has
    /// its own copy, which costs nothing.
    /// </summary>
    public sealed unsafe partial class Graph : IDisposable
    {
        private readonly GraphHandle handle;

        internal Graph(IntPtr graph)
        {
            handle = new GraphHandle(graph);
        }

        /// <summary>Width of its results in pixels.</summary>
        public int Width
        {
            get { return (int)Info().Width; }
        }

        /// <summary>Height of its results in pixels.</summary>
        public int Height
        {
            get { return (int)Info().Height; }
        }

        /// <summary>The seed of all blocks that have none of their own.</summary>
        public ulong Seed
        {
            get
            {
                return Info().Seed;
            }

            set
            {
                IntPtr error;
                using (var graph = handle.Use())
                {
                    var status = NativeMethods.ptl_graph_set_seed(graph.Pointer, value, &error);
                    Errors.Check(status, error);
                }
            }
        }

        /// <summary>Each pixel of the results is the mean of this many times this many, 1 to 6.
        /// </summary>
        public int Supersampling
        {
            get
            {
                return (int)Info().Supersampling;
            }

            set
            {
                IntPtr error;
                using (var graph = handle.Use())
                {
                    var status = NativeMethods.ptl_graph_set_supersampling(
                        graph.Pointer, Number.Unsigned(value, nameof(value)), &error);
                    Errors.Check(status, error);
                }
            }
        }

        /// <summary>What values are computed in; never <see cref="PtLib.Precision.Default"/>.
        /// </summary>
        public Precision Precision
        {
            get
            {
                return (Precision)Info().Precision;
            }

            set
            {
                IntPtr error;
                using (var graph = handle.Use())
                {
                    var status = NativeMethods.ptl_graph_set_precision(
                        graph.Pointer, (uint)value, &error);
                    Errors.Check(status, error);
                }
            }
        }

        /// <summary>
        /// What the file that the graph was read from says and the graph does not follow.
        /// </summary>
        public IReadOnlyList<Fault> Warnings
        {
            get
            {
                using (var graph = handle.Use())
                {
                    var warnings =
                        new Fault[NativeMethods.ptl_graph_warning_count(graph.Pointer)];
                    for (var i = 0; i < warnings.Length; i++)
                    {
                        var fault = new NativeFault { StructSize = (uint)sizeof(NativeFault) };
                        var status =
                            NativeMethods.ptl_graph_warning_at(graph.Pointer, (uint)i, &fault);
                        Errors.Check(status, IntPtr.Zero);
                        warnings[i] = new Fault(fault);
                    }
                    return warnings;
                }
            }
        }

        /// <summary>Its blocks, in file order. The list does not change with the graph.</summary>
        public IReadOnlyList<Block> Blocks
        {
            get
            {
                using (var graph = handle.Use())
                {
                    var blocks = new Block[NativeMethods.ptl_graph_block_count(graph.Pointer)];
                    for (var i = 0; i < blocks.Length; i++)
                    {
                        blocks[i] = new Block(
                            this, NativeMethods.ptl_graph_block_at(graph.Pointer, (uint)i));
                    }
                    return blocks;
                }
            }
        }

        /// <summary>
        /// The result to take when one is wanted: the last block of type "end" in file order.
        /// Null if there is none.
        /// </summary>
        public Block? MainResult
        {
            get
            {
                using (var graph = handle.Use())
                {
                    return Found(NativeMethods.ptl_graph_main_result(graph.Pointer));
                }
            }
        }

        /// <summary>Sets the size of the results in pixels.</summary>
        /// <param name="width">The width.</param>
        /// <param name="height">The height.</param>
        public void SetSize(int width, int height)
        {
            IntPtr error;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_set_size(
                    graph.Pointer,
                    Number.Unsigned(width, nameof(width)),
                    Number.Unsigned(height, nameof(height)),
                    &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>
        /// Sets the folder that paths in parameters are relative to and that blocks may read files
        /// below.
        /// </summary>
        /// <param name="folder">The folder; null for a graph that reads no files.</param>
        public void SetFolder([AllowNull] string folder)
        {
            IntPtr error;
            using (var graph = handle.Use())
            fixed (byte* text = Utf8.OfOptional(folder, nameof(folder)))
            {
                var status = NativeMethods.ptl_graph_set_folder(graph.Pointer, text, &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>Copies the graph. It costs nothing until one of the two is changed.</summary>
        /// <returns>The copy; dispose of it. <see cref="FromHandle"/> finds its blocks by the
        /// handles that they have here.</returns>
        public Graph Clone()
        {
            IntPtr copy, error;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_clone(graph.Pointer, &copy, &error);
                Errors.Check(status, error);
                return new Graph(copy);
            }
        }

        /// <summary>The graph as the contents of a file. Nothing that its file said is lost.
        /// </summary>
        /// <returns>The bytes.</returns>
        public byte[] Save()
        {
            IntPtr bytes, error;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_save(graph.Pointer, &bytes, &error);
                Errors.Check(status, error);
            }
            try
            {
                UIntPtr size;
                var data = NativeMethods.ptl_bytes_data(bytes, &size);
                var contents = new byte[checked((int)size)];
                Marshal.Copy((IntPtr)data, contents, 0, contents.Length);
                return contents;
            }
            finally
            {
                NativeMethods.ptl_bytes_release(bytes);
            }
        }

        /// <summary>Gives up the graph. Computations of it go on.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }

        internal Lease Use()
        {
            return handle.Use();
        }

        private NativeGraphInfo Info()
        {
            IntPtr error;
            var info = new NativeGraphInfo { StructSize = (uint)sizeof(NativeGraphInfo) };
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_get_info(graph.Pointer, &info, &error);
                Errors.Check(status, error);
            }
            return info;
        }
    }
}
