using System.Collections.Generic;

namespace PtLib
{
    /// <summary>How an engine is made. What is 0 or empty means: as usual.</summary>
    public sealed class EngineOptions
    {
        /// <summary>Results are not kept for later computations.</summary>
        public bool DisableCache { get; set; }

        /// <summary>The most threads of one computation, the caller's included; usually one per
        /// processor.</summary>
        public int Threads { get; set; }

        /// <summary>Bytes that results kept for later computations may take; usually 256 MiB.
        /// </summary>
        public long CacheBytes { get; set; }

        /// <summary>Limit: bytes that one computation may take at its peak.</summary>
        public long MaxMemoryBytes { get; set; }

        /// <summary>Limit: bytes of a graph file.</summary>
        public long MaxFileBytes { get; set; }

        /// <summary>Limit: bytes of a file that a block reads.</summary>
        public long MaxReadBytes { get; set; }

        /// <summary>Limit: blocks of a graph file.</summary>
        public int MaxBlocks { get; set; }

        /// <summary>Limit: connections of a graph file.</summary>
        public int MaxConnections { get; set; }

        /// <summary>Limit: bytes of one text parameter in a graph file.</summary>
        public int MaxTextBytes { get; set; }

        /// <summary>Limit: symbols of the string of an L-system.</summary>
        public int MaxTextSymbols { get; set; }

        /// <summary>Limit: width and height of an image, supersampling included.</summary>
        public int MaxImageSide { get; set; }

        /// <summary>Limit: faults that are collected from one graph file.</summary>
        public int MaxFaults { get; set; }

        /// <summary>Folders below which every graph may read files, besides its own folder.
        /// </summary>
        public IList<string> ReadFolders { get; } = new List<string>();

        /// <summary>Folders below which graphs may write files; usually they may not.</summary>
        public IList<string> WriteFolders { get; } = new List<string>();
    }
}
