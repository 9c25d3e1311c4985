using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// What computations share: the block types, the threads, the cache, the limits. Any thread
    /// may use it. Graphs keep the library's side of it alive, so it may be disposed of before
    /// them.
    /// </summary>
    public sealed unsafe class Engine : IDisposable
    {
        private readonly EngineHandle handle;

        /// <summary>Makes an engine with the built-in block types.</summary>
        /// <param name="options">How; null: as usual.</param>
        /// <exception cref="PtLibLoadException">The native library cannot be used.</exception>
        /// <exception cref="ArgumentOutOfRangeException">An option is negative.</exception>
        public Engine([AllowNull] EngineOptions options = null)
        {
            Loader.Ensure();
            handle = Create(options ?? new EngineOptions());
        }

        /// <summary>
        /// All block types: the built-in ones by family, then those of plug-ins in the order in
        /// which they came. The list does not change; ask again after plug-ins were added.
        /// </summary>
        public IReadOnlyList<BlockType> BlockTypes
        {
            get
            {
                using (var engine = handle.Use())
                {
                    var types = new BlockType[
                        NativeMethods.ptl_engine_block_type_count(engine.Pointer)];
                    for (var i = 0; i < types.Length; i++)
                    {
                        types[i] = new BlockType(
                            NativeMethods.ptl_engine_block_type_at(engine.Pointer, (uint)i));
                    }
                    return types;
                }
            }
        }

        /// <summary>The block type of an id, such as "perlin noise".</summary>
        /// <param name="id">The id.</param>
        /// <returns>Null if there is none.</returns>
        [return: MaybeNull]
        public BlockType FindBlockType(string id)
        {
            using (var engine = handle.Use())
            fixed (byte* text = Utf8.Of(id, nameof(id)))
            {
                var type = NativeMethods.ptl_engine_find_block_type(engine.Pointer, text);
                return type == IntPtr.Zero ? default(BlockType) : new BlockType(type);
            }
        }

        /// <summary>Makes an empty graph.</summary>
        /// <returns>The graph; dispose of it.</returns>
        public Graph CreateGraph()
        {
            IntPtr graph, error;
            using (var engine = handle.Use())
            {
                var status = NativeMethods.ptl_graph_create(engine.Pointer, &graph, &error);
                Errors.Check(status, error);
                return new Graph(graph);
            }
        }

        /// <summary>
        /// Reads the contents of a graph file. Its blocks may read files only after
        /// <see cref="Graph.SetFolder"/>, or below <see cref="EngineOptions.ReadFolders"/>.
        /// </summary>
        /// <param name="contents">The bytes of the file.</param>
        /// <returns>The graph; dispose of it.</returns>
        /// <exception cref="PtLibException">The contents are wrong;
        /// <see cref="PtLibException.Faults"/> has all faults.</exception>
        public Graph LoadGraph(byte[] contents)
        {
            if (contents == null)
            {
                throw new ArgumentNullException(nameof(contents));
            }
            IntPtr graph, error;
            using (var engine = handle.Use())
            fixed (byte* data = contents)
            {
                var status = NativeMethods.ptl_graph_load(
                    engine.Pointer, data, (UIntPtr)contents.Length, &graph, &error);
                Errors.Check(status, error);
                return new Graph(graph);
            }
        }

        /// <summary>Reads a graph file. Its blocks may read files below its folder.</summary>
        /// <param name="path">The path of the file.</param>
        /// <returns>The graph; dispose of it.</returns>
        /// <exception cref="PtLibException">The file cannot be read, or its contents are wrong;
        /// <see cref="PtLibException.Faults"/> has all faults.</exception>
        public Graph LoadGraphFile(string path)
        {
            IntPtr graph, error;
            using (var engine = handle.Use())
            fixed (byte* text = Utf8.Of(path, nameof(path)))
            {
                var status =
                    NativeMethods.ptl_graph_load_file(engine.Pointer, text, &graph, &error);
                Errors.Check(status, error);
                return new Graph(graph);
            }
        }

        /// <summary>
        /// Sends the engine's messages, such as the warnings of graph files, to a function. It
        /// replaces the one before. The function may run on any thread, on several at once; what
        /// it throws is dropped.
        /// </summary>
        /// <param name="minimum">Messages below this level are left out.</param>
        /// <param name="log">Gets each message; null: nobody does.</param>
        public void SetLog(LogLevel minimum, [AllowNull] Action<LogLevel, string> log)
        {
            IntPtr error;
            using (var engine = handle.Use())
            {
                if (log == null)
                {
                    var cleared = NativeMethods.ptl_engine_set_log(
                        engine.Pointer, (int)minimum, IntPtr.Zero, null, IntPtr.Zero, &error);
                    Errors.Check(cleared, error);
                    return;
                }
                var kept = GCHandle.Alloc(log);
                var status = NativeMethods.ptl_engine_set_log(
                    engine.Pointer, (int)minimum, Callbacks.Log, (void*)GCHandle.ToIntPtr(kept),
                    Callbacks.Free, &error);
                if (status != (int)Status.Ok)
                {
                    kept.Free();
                }
                Errors.Check(status, error);
            }
        }

        /// <summary>
        /// Loads a plug-in from a file, and adds its block types. This runs code of the file with
        /// all rights of the program: only load what you trust. Loading one again changes nothing.
        /// </summary>
        /// <param name="path">The file; it ends with .ptplugin.so (.dll, .dylib).</param>
        /// <exception cref="PtLibException">The status and the message say what is wrong with it.
        /// </exception>
        public void LoadPlugin(string path)
        {
            IntPtr error;
            using (var engine = handle.Use())
            fixed (byte* text = Utf8.Of(path, nameof(path)))
            {
                var status =
                    NativeMethods.ptl_engine_load_plugin(engine.Pointer, text, &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>
        /// Loads every plug-in in some folders, and adds their block types. A file that is refused
        /// does not end the search. Of two plug-ins with a block type of one id, the first wins.
        /// </summary>
        /// <param name="folders">Folders, separated as in PATH; null: those of the variable
        /// PTLIB_PLUGIN_PATH, of the user, and of the system.</param>
        /// <param name="report">Hears of each file; false ends the search. May be null.</param>
        /// <returns>What became of each file.</returns>
        public IReadOnlyList<Plugin> ScanPlugins(
            [AllowNull] string folders = null, [AllowNull] Func<Plugin, bool> report = null)
        {
            var scan = new PluginScan(report);
            var state = GCHandle.Alloc(scan);
            try
            {
                IntPtr error;
                using (var engine = handle.Use())
                fixed (byte* text = Utf8.OfOptional(folders, nameof(folders)))
                {
                    var status = NativeMethods.ptl_engine_scan_plugins(
                        engine.Pointer, text, Callbacks.Scan, (void*)GCHandle.ToIntPtr(state),
                        &error);
                    scan.Check(status, error);
                }
                return scan.Found;
            }
            finally
            {
                state.Free();
            }
        }

        /// <summary>
        /// Adds the blocks of a plug-in written in C#. Adding one again changes nothing.
        /// </summary>
        /// <param name="plugin">The plug-in.</param>
        /// <exception cref="PtLibException">It describes itself wrongly, or another plug-in has a
        /// block of the same id; the message says what.</exception>
        public void Register(Blocks.ManagedPlugin plugin)
        {
            if (plugin == null)
            {
                throw new ArgumentNullException(nameof(plugin));
            }
            IntPtr error;
            using (var engine = handle.Use())
            {
                var status = NativeMethods.ptl_engine_register_plugin(
                    engine.Pointer, plugin.Entry, &error);
                Errors.Check(status, error);
            }
        }

        /// <summary>Gives up the engine. Its graphs go on.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }

        internal Lease Use()
        {
            return handle.Use();
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static EngineHandle Create(EngineOptions options)
        {
            using (var read = new TextList(options.ReadFolders, nameof(options.ReadFolders)))
            using (var write = new TextList(options.WriteFolders, nameof(options.WriteFolders)))
            {
                var native = new NativeEngineOptions
                {
                    StructSize = (uint)sizeof(NativeEngineOptions),
                    Flags = options.DisableCache ? 1u : 0u,
                    Threads = Number.Unsigned(options.Threads, nameof(options.Threads)),
                    CacheBytes = Number.Unsigned(options.CacheBytes, nameof(options.CacheBytes)),
                    MaxMemoryBytes =
                        Number.Unsigned(options.MaxMemoryBytes, nameof(options.MaxMemoryBytes)),
                    MaxFileBytes =
                        Number.Unsigned(options.MaxFileBytes, nameof(options.MaxFileBytes)),
                    MaxReadBytes =
                        Number.Unsigned(options.MaxReadBytes, nameof(options.MaxReadBytes)),
                    MaxBlocks = Number.Unsigned(options.MaxBlocks, nameof(options.MaxBlocks)),
                    MaxConnections =
                        Number.Unsigned(options.MaxConnections, nameof(options.MaxConnections)),
                    MaxTextBytes =
                        Number.Unsigned(options.MaxTextBytes, nameof(options.MaxTextBytes)),
                    MaxTextSymbols =
                        Number.Unsigned(options.MaxTextSymbols, nameof(options.MaxTextSymbols)),
                    MaxImageSide =
                        Number.Unsigned(options.MaxImageSide, nameof(options.MaxImageSide)),
                    MaxFaults = Number.Unsigned(options.MaxFaults, nameof(options.MaxFaults)),
                    ReadFolderCount = read.Count,
                    WriteFolderCount = write.Count,
                    ReadFolders = read.Pointer,
                    WriteFolders = write.Pointer,
                };
                IntPtr engine, error;
                var status = NativeMethods.ptl_engine_create(&native, &engine, &error);
                Errors.Check(status, error);
                return new EngineHandle(engine);
            }
        }
    }
}
