using System;
using PtLib.Native;

namespace PtLib
{
    // Adding, finding and connecting blocks.
    public sealed unsafe partial class Graph
    {
        /// <summary>Adds a block with default parameters.</summary>
        /// <param name="type">The id of its type, such as "perlin noise".</param>
        /// <returns>The block.</returns>
        /// <exception cref="PtLibException">There is no such type.</exception>
        public Block Add(string type)
        {
            ulong block = 0;
            IntPtr error;
            using (var graph = handle.Use())
            fixed (byte* text = Utf8.Of(type, nameof(type)))
            {
                var status =
                    NativeMethods.ptl_graph_add_block(graph.Pointer, text, &block, &error);
                Errors.Check(status, error);
            }
            return new Block(this, block);
        }

        /// <summary>Removes a block and all its connections.</summary>
        /// <param name="block">The block.</param>
        public void Remove(Block block)
        {
            IntPtr error;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_remove_block(
                    graph.Pointer, Own(block, nameof(block)), &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>The first block, in file order, of an id in the graph's file.</summary>
        /// <param name="fileId">The id.</param>
        /// <returns>Null if there is none.</returns>
        public Block? Find(string fileId)
        {
            using (var graph = handle.Use())
            fixed (byte* text = Utf8.Of(fileId, nameof(fileId)))
            {
                return Found(NativeMethods.ptl_graph_find_block(graph.Pointer, text));
            }
        }

        /// <summary>The first input of the graph, in file order, of a name.</summary>
        /// <param name="name">What its parameter "name" says.</param>
        /// <returns>Null if there is none.</returns>
        public Block? FindInput(string name)
        {
            using (var graph = handle.Use())
            fixed (byte* text = Utf8.Of(name, nameof(name)))
            {
                return Found(NativeMethods.ptl_graph_find_input(graph.Pointer, text));
            }
        }

        /// <summary>
        /// The block of a handle, such as that of an exception, or of a block in the graph that
        /// this is a clone of.
        /// </summary>
        /// <param name="blockHandle">The handle.</param>
        /// <returns>The block. Using it fails if the graph has no such block.</returns>
        public Block FromHandle(ulong blockHandle)
        {
            return new Block(this, blockHandle);
        }

        /// <summary>
        /// Connects an output with an input; ports count from 0. What was connected there before
        /// is replaced.
        /// </summary>
        /// <param name="source">The block whose output it is.</param>
        /// <param name="target">The block whose input it is.</param>
        /// <param name="input">The number of the input.</param>
        /// <param name="output">The number of the output.</param>
        /// <exception cref="PtLibException">There is no such port, the ports are of different
        /// kinds, or the target would depend on itself.</exception>
        public void Connect(Block source, Block target, int input = 0, int output = 0)
        {
            IntPtr error;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_connect(
                    graph.Pointer,
                    Own(source, nameof(source)),
                    Number.Unsigned(output, nameof(output)),
                    Own(target, nameof(target)),
                    Number.Unsigned(input, nameof(input)),
                    &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>Removes what is connected to an input; fine if nothing is.</summary>
        /// <param name="target">The block whose input it is.</param>
        /// <param name="input">The number of the input.</param>
        public void Disconnect(Block target, int input = 0)
        {
            IntPtr error;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_disconnect(
                    graph.Pointer,
                    Own(target, nameof(target)),
                    Number.Unsigned(input, nameof(input)),
                    &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>What is connected to an input.</summary>
        /// <param name="target">The block whose input it is.</param>
        /// <param name="input">The number of the input.</param>
        /// <returns>The block and its output; null if nothing is.</returns>
        public Connection? Source(Block target, int input = 0)
        {
            IntPtr error;
            ulong block = 0;
            uint output = 0;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_input_source(
                    graph.Pointer,
                    Own(target, nameof(target)),
                    Number.Unsigned(input, nameof(input)),
                    &block,
                    &output,
                    &error);
                Errors.Check(status, error);
            }
            return block == 0
                ? default(Connection?)
                : new Connection(new Block(this, block), (int)output);
        }

        /// <summary>
        /// Checks whether a block can be computed, as far as the graph alone tells: every type
        /// that it needs is known, every required input is connected, every connection is of the
        /// right kind.
        /// </summary>
        /// <param name="block">The block.</param>
        /// <exception cref="PtLibException">It cannot; <see cref="PtLibException.Faults"/> has all
        /// faults.</exception>
        public void Validate(Block block)
        {
            IntPtr error;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_validate(
                    graph.Pointer, Own(block, nameof(block)), &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>
        /// Sets the value of an input of the graph (a block type with
        /// <see cref="BlockTypeFlags.IsInput"/>). The graph keeps what it needs of the value,
        /// which may be disposed of at once. Values are not saved with the graph.
        /// </summary>
        /// <param name="block">The input.</param>
        /// <param name="value">The value.</param>
        /// <exception cref="PtLibException">The block is no input, or takes values of another
        /// kind.</exception>
        public void SetInput(Block block, Value value)
        {
            if (value == null)
            {
                throw new ArgumentNullException(nameof(value));
            }
            IntPtr error;
            using (var graph = handle.Use())
            using (var given = value.Use())
            {
                var status = NativeMethods.ptl_graph_set_input(
                    graph.Pointer, Own(block, nameof(block)), given.Pointer, &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>Sets the value of the first input of the graph of a name.</summary>
        /// <param name="name">What its parameter "name" says.</param>
        /// <param name="value">The value.</param>
        /// <exception cref="PtLibException">There is no such input, or it takes values of another
        /// kind.</exception>
        public void SetInput(string name, Value value)
        {
            var block = FindInput(name);
            if (!block.HasValue)
            {
                throw new PtLibException(
                    Status.NotFound,
                    "The graph has no input of the name \"" + name + "\".",
                    nameof(name));
            }
            SetInput(block.Value, value);
        }

        /// <summary>Takes the value of an input of the graph back: then its default counts.
        /// </summary>
        /// <param name="block">The input.</param>
        public void ClearInput(Block block)
        {
            IntPtr error;
            using (var graph = handle.Use())
            {
                var status = NativeMethods.ptl_graph_set_input(
                    graph.Pointer, Own(block, nameof(block)), IntPtr.Zero, &error);
                Errors.Check(status, error);
            }
        }

        private Block? Found(ulong block)
        {
            return block == 0 ? default(Block?) : new Block(this, block);
        }

        /// <summary>The handle of a block, which must be one of this graph.</summary>
        private ulong Own(Block block, string parameter)
        {
            if (!ReferenceEquals(block.Graph, this))
            {
                throw new ArgumentException(
                    "The block belongs to another graph. FromHandle finds the block of a clone.",
                    parameter);
            }
            return block.Handle;
        }
    }
}
