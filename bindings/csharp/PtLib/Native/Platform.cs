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

        private static string[] Names()
        {
            if (IsWindows)
            {
                return new[] { "ptlib.dll" };
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
