using System;
using System.Runtime.InteropServices;
using PtLib.Native;

namespace PtLib.Blocks
{
    /// <summary>
    /// Blocks written in C# as a plug-in, for <see cref="Engine.Register"/>. The library keeps
    /// what it knows about a plug-in as long as the process lives: make each plug-in once.
    /// </summary>
    public sealed unsafe class ManagedPlugin
    {
        private const uint AbiMajor = 1;
        private const uint ThreadsTiles = 1;
        private const uint OptionalPort = 1;
        private const uint FreeRangePort = 4;
        private const uint SeedFlag = 1;

        /// <summary>Describes a plug-in.</summary>
        /// <param name="id">Its id: the vendor of its blocks, or the vendor, a point and a word.
        /// </param>
        /// <param name="version">Its version, such as "1.2.0".</param>
        /// <param name="license">The SPDX expression of its licence, such as "MIT".</param>
        /// <param name="blocks">Its blocks.</param>
        public ManagedPlugin(
            string id, string version, string license, params ManagedBlock[] blocks)
        {
            if (blocks == null)
            {
                throw new ArgumentNullException(nameof(blocks));
            }
            var entry = (NativeEntry*)Zeroed(sizeof(NativeEntry));
            entry->StructSize = (uint)sizeof(NativeEntry);
            entry->AbiMajor = AbiMajor;
            entry->Id = Utf8.Keep(id, nameof(id));
            entry->Name = entry->Id;
            entry->Vendor = entry->Id;
            entry->Version = Utf8.Keep(version, nameof(version));
            entry->License = Utf8.Keep(license, nameof(license));
            entry->BuiltWith = Utf8.Keep(".NET " + Environment.Version, nameof(id));
            entry->BlockCount = (uint)blocks.Length;
            entry->Blocks = (NativeBlock**)Zeroed(blocks.Length * sizeof(void*));
            for (var i = 0; i < blocks.Length; i++)
            {
                entry->Blocks[i] = Describe(
                    blocks[i] ?? throw new ArgumentNullException(nameof(blocks)));
            }
            Entry = (IntPtr)entry;
        }

        /// <summary>The ptlp_entry.</summary>
        internal IntPtr Entry { get; }

        private static NativeBlock* Describe(ManagedBlock block)
        {
            var native = (NativeBlock*)Zeroed(sizeof(NativeBlock));
            native->StructSize = (uint)sizeof(NativeBlock);
            native->Version = (uint)block.Version;
            native->Shape = block.Shape;
            native->ThreadMode = ThreadsTiles;
            native->Flags = block.UsesSeed ? SeedFlag : 0;
            native->InputCount = (uint)block.Inputs.Count;
            native->OutputCount = 1;
            native->ParamCount = (uint)block.Parameters.Count;
            native->Id = Utf8.Keep(block.Id, nameof(block));
            native->Category = Utf8.Keep(block.Category, nameof(block));
            native->Doc = Utf8.Keep(block.Documentation, nameof(block));
            if (block.TilingException.Length > 0)
            {
                native->TilingException = Utf8.Keep(block.TilingException, nameof(block));
            }
            native->Inputs = (NativePort**)Zeroed(block.Inputs.Count * sizeof(void*));
            for (var i = 0; i < block.Inputs.Count; i++)
            {
                native->Inputs[i] = Port(block.Inputs[i].Key);
                native->Inputs[i]->Flags = block.Inputs[i].Value ? OptionalPort : 0;
            }
            native->Outputs = (NativePort**)Zeroed(sizeof(void*));
            native->Outputs[0] = Port("image");
            native->Outputs[0]->Planes = (uint)block.OutputChannels;
            native->Outputs[0]->Flags = block.HasFreeRange ? FreeRangePort : 0;
            native->Params = (NativeParam**)Zeroed(block.Parameters.Count * sizeof(void*));
            for (var i = 0; i < block.Parameters.Count; i++)
            {
                native->Params[i] = Describe(block.Parameters[i]);
            }
            native->UserData = GCHandle.ToIntPtr(GCHandle.Alloc(block));
            native->Create = BlockCallbacks.Create;
            native->Destroy = BlockCallbacks.Destroy;
            native->Prepare = BlockCallbacks.Prepare;
            native->Compute = BlockCallbacks.Compute;
            return native;
        }

        private static NativePort* Port(string id)
        {
            var port = (NativePort*)Zeroed(sizeof(NativePort));
            port->StructSize = (uint)sizeof(NativePort);
            port->Kind = (uint)ValueKind.Image;
            port->Id = Utf8.Keep(id, nameof(id));
            return port;
        }

        private static NativeParam* Describe(BlockParameter parameter)
        {
            var native = (NativeParam*)Zeroed(sizeof(NativeParam));
            native->StructSize = (uint)sizeof(NativeParam);
            native->Type = (uint)parameter.Kind;
            native->Id = Utf8.Keep(parameter.Id, nameof(parameter));
            native->Doc = Utf8.Keep(parameter.Documentation, nameof(parameter));
            native->Min = native->SoftMin = parameter.Minimum;
            native->Max = native->SoftMax = parameter.Maximum;
            native->DefaultValue = parameter.Default;
            if (parameter.Kind == ParameterKind.Text)
            {
                native->DefaultText = Utf8.Keep(parameter.DefaultText, nameof(parameter));
            }
            if (parameter.Kind == ParameterKind.Choice)
            {
                native->ChoiceCount = (uint)parameter.Choices.Length;
                native->ChoiceIds = (byte**)Zeroed(parameter.Choices.Length * sizeof(void*));
                for (var i = 0; i < parameter.Choices.Length; i++)
                {
                    native->ChoiceIds[i] = Utf8.Keep(parameter.Choices[i], nameof(parameter));
                }
            }
            return native;
        }

        /// <summary>Memory that is never freed: the library keeps pointers to it.</summary>
        private static void* Zeroed(int size)
        {
            var memory = (byte*)Marshal.AllocHGlobal(Math.Max(1, size));
            for (var i = 0; i < size; i++)
            {
                memory[i] = 0;
            }
            return memory;
        }
    }
}
