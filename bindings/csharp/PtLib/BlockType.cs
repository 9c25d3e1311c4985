using System;
using System.Collections.Generic;
using PtLib.Native;

namespace PtLib
{
    /// <summary>A block type: what it is called, and what its blocks have.</summary>
    public sealed unsafe class BlockType
    {
        // The description lives as long as the engine or a graph of it, which the caller has in
        // use; after this was made, nothing of it is needed.
        internal BlockType(IntPtr type)
        {
            Id = Utf8.Read(NativeMethods.ptl_block_type_id(type));
            Name = Utf8.Read(NativeMethods.ptl_block_type_name(type));
            Category = Utf8.Read(NativeMethods.ptl_block_type_category(type));
            Documentation = Utf8.Read(NativeMethods.ptl_block_type_doc(type));
            PluginId = Utf8.Read(NativeMethods.ptl_block_type_plugin(type));
            Flags = (BlockTypeFlags)NativeMethods.ptl_block_type_flags(type);
            Parameters = ReadParameters(type);
            Inputs = ReadPorts(type, true);
            Outputs = ReadPorts(type, false);
        }

        /// <summary>Its id in files and in this interface.</summary>
        public string Id { get; }

        /// <summary>Its name for a user interface.</summary>
        public string Name { get; }

        /// <summary>Its family, such as "noise".</summary>
        public string Category { get; }

        /// <summary>What it makes, in a sentence.</summary>
        public string Documentation { get; }

        /// <summary>The id of the plug-in that it comes from; empty for built-in ones.</summary>
        public string PluginId { get; }

        /// <summary>What holds for its blocks.</summary>
        public BlockTypeFlags Flags { get; }

        /// <summary>Its parameters.</summary>
        public IReadOnlyList<Parameter> Parameters { get; }

        /// <summary>Its inputs.</summary>
        public IReadOnlyList<Port> Inputs { get; }

        /// <summary>Its outputs.</summary>
        public IReadOnlyList<Port> Outputs { get; }

        /// <summary>The id.</summary>
        /// <returns><see cref="Id"/></returns>
        public override string ToString()
        {
            return Id;
        }

        private static Parameter[] ReadParameters(IntPtr type)
        {
            var parameters = new Parameter[NativeMethods.ptl_block_type_param_count(type)];
            for (var i = 0; i < parameters.Length; i++)
            {
                var info = new NativeParamInfo { StructSize = (uint)sizeof(NativeParamInfo) };
                var status = NativeMethods.ptl_block_type_param_info(type, (uint)i, &info);
                Errors.Check(status, IntPtr.Zero);
                parameters[i] = new Parameter(info);
            }
            return parameters;
        }

        private static Port[] ReadPorts(IntPtr type, bool isInput)
        {
            var ports = new Port[isInput
                ? NativeMethods.ptl_block_type_input_count(type)
                : NativeMethods.ptl_block_type_output_count(type)];
            for (var i = 0; i < ports.Length; i++)
            {
                var info = new NativePortInfo { StructSize = (uint)sizeof(NativePortInfo) };
                var status = isInput
                    ? NativeMethods.ptl_block_type_input_info(type, (uint)i, &info)
                    : NativeMethods.ptl_block_type_output_info(type, (uint)i, &info);
                Errors.Check(status, IntPtr.Zero);
                ports[i] = new Port(info);
            }
            return ports;
        }
    }
}
