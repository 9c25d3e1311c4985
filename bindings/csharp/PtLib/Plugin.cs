using PtLib.Native;

namespace PtLib
{
    /// <summary>What became of a file in which a plug-in was looked for.</summary>
    public sealed class Plugin
    {
        internal unsafe Plugin(NativeScanReport report)
        {
            Status = (Status)report.Status;
            Path = Utf8.Read(report.Path);
            Id = Utf8.Read(report.PluginId);
            Version = Utf8.Read(report.PluginVersion);
            BuiltWith = Utf8.Read(report.BuiltWith);
            Message = Utf8.Read(report.Message);
            BlockTypeCount = (int)report.BlockCount;
        }

        /// <summary><see cref="PtLib.Status.Ok"/> if its block types can be used now; else why
        /// not.</summary>
        public Status Status { get; }

        /// <summary>The file, or a folder that cannot be read.</summary>
        public string Path { get; }

        /// <summary>The id of the plug-in; empty after an error.</summary>
        public string Id { get; }

        /// <summary>Its version; empty after an error.</summary>
        public string Version { get; }

        /// <summary>The compiler that built it; empty if it does not say so, and after an error.
        /// </summary>
        public string BuiltWith { get; }

        /// <summary>What is wrong, and what to do; empty if nothing is.</summary>
        public string Message { get; }

        /// <summary>How many block types it has; 0 after an error.</summary>
        public int BlockTypeCount { get; }
    }
}
