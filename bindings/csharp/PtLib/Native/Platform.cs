using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>What libraries and folders are called here.</summary>
    internal static class Platform
    {
        internal static readonly bool IsMono = Type.GetType("Mono.Runtime") != null;

        internal static readonly bool IsWindows = Path.DirectorySeparatorChar == '\\';

        private static readonly bool IsMacOs =
            !IsWindows && RuntimeInformation.IsOSPlatform(OSPlatform.OSX);

        /// <summary>The names that the library may have, the most specific first.</summary>
        internal static readonly string[] FileNames = Names();

        /// <summary>
        /// The names in a folder that was named for the library. On Windows that of the C library
        /// is one of them, where libraries are loaded by their paths; beside an assembly it would be
        /// the assembly, PtLib.dll.
        /// </summary>
        internal static readonly string[] FileNamesApart =
#if NET8_0_OR_GREATER
            IsWindows ? new[] { FileNames[0], "ptlib.dll" } : FileNames;
#else
            FileNames;
#endif

        private static string[] Names()
        {
            if (IsWindows)
            {
                return new[] { "libptlib.dll" };
            }
            return IsMacOs
                ? new[] { "libptlib." + NativeMethods.AbiVersion + ".dylib", "libptlib.dylib" }
                : new[] { "libptlib.so." + NativeMethods.AbiVersion, "libptlib.so" };
        }

        /// <summary>
        /// The portable runtime ids whose libraries may run here. A system with musl instead of
        /// glibc is told by its loader.
        /// </summary>
        internal static IEnumerable<string> RuntimeIds()
        {
            var processor = RuntimeInformation.ProcessArchitecture.ToString().ToLowerInvariant();
            if (IsWindows || IsMacOs)
            {
                yield return (IsWindows ? "win-" : "osx-") + processor;
                yield break;
            }
            if (HasMusl())
            {
                yield return "linux-musl-" + processor;
            }
            yield return "linux-" + processor;
        }

        private static bool HasMusl()
        {
            return Directory.Exists("/lib") &&
                Directory.GetFiles("/lib", "ld-musl-*").Length > 0;
        }
    }
}
