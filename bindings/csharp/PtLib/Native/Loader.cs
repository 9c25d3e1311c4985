using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.IO;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>
    /// Finds the native library, and refuses one of another version. It looks in this order, and
    /// takes the first file that is there:
    /// the variable PTLIB_NATIVE_PATH (a file or a folder; if it is set, nothing else counts), the
    /// folder of this assembly and that of the program, runtimes/RID/native below those, and what
    /// the system finds by itself.
    /// <para>
    /// Whoever calls a function of the library first calls <see cref="Ensure"/>, and the function
    /// only in another method that is not inlined: mono resolves functions when it compiles the
    /// method that calls them.
    /// </para>
    /// </summary>
    internal static class Loader
    {
        /// <summary>An AppContext switch: the program finds the library by itself.</summary>
        internal const string SwitchOff = "PtLib.DisableNativeResolver";

        internal const string PathVariable = "PTLIB_NATIVE_PATH";

        private static readonly object Gate = new object();
        private static readonly List<string> Tried = new List<string>();
        private static volatile bool isLoaded;

        /// <summary>The file that was loaded; empty if the system found it by itself.</summary>
        internal static string LoadedFrom { get; private set; } = string.Empty;

        /// <summary>Loads the library, or says why that is not possible.</summary>
        internal static void Ensure()
        {
            if (isLoaded)
            {
                return;
            }
            lock (Gate)
            {
                if (!isLoaded)
                {
                    Tried.Clear();
                    Load();
                    isLoaded = true;
                }
            }
        }

        private static void Load()
        {
            bool isOff;
            if (!(AppContext.TryGetSwitch(SwitchOff, out isOff) && isOff))
            {
                var file = Find();
                if (file != null && NativeImage.Bind(file))
                {
                    LoadedFrom = file;
                }
            }
            if (LoadedFrom.Length == 0)
            {
                Tried.Add("\"" + NativeMethods.Library + "\" where the system looks");
            }
            uint found;
            try
            {
                found = FoundVersion();
            }
            catch (Exception exception) when (IsOfLoading(exception))
            {
                throw Failure("it could not be loaded: " + exception.Message, exception);
            }
            if (found != NativeMethods.AbiVersion)
            {
                throw Failure(
                    "it has ABI version " + found + ", but this assembly is made for version " +
                    NativeMethods.AbiVersion + "; install the package of the same version", null);
            }
        }

        private static bool IsOfLoading(Exception exception)
        {
            return exception is DllNotFoundException || exception is EntryPointNotFoundException ||
                exception is BadImageFormatException;
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static uint FoundVersion()
        {
            return NativeMethods.ptl_abi_version();
        }

        /// <summary>The first file that is there; null if none is.</summary>
        [return: MaybeNull]
        private static string Find()
        {
            var wanted = Environment.GetEnvironmentVariable(PathVariable);
            if (!string.IsNullOrEmpty(wanted))
            {
                return FindWanted(wanted);
            }
            foreach (var folder in Folders())
            {
                foreach (var name in Platform.FileNames)
                {
                    var file = Path.Combine(folder, name);
                    Tried.Add(file);
                    if (File.Exists(file))
                    {
                        return file;
                    }
                }
            }
            return null;
        }

        private static string FindWanted(string wanted)
        {
            if (!Directory.Exists(wanted))
            {
                Tried.Add(wanted);
                if (!File.Exists(wanted))
                {
                    throw Failure(
                        PathVariable + " names a file that is not there; " +
                        "set it to the library or its folder, or unset it", null);
                }
                return Path.GetFullPath(wanted);
            }
            foreach (var name in Platform.FileNamesApart)
            {
                var file = Path.GetFullPath(Path.Combine(wanted, name));
                Tried.Add(file);
                if (File.Exists(file))
                {
                    return file;
                }
            }
            throw Failure(PathVariable + " names a folder without the library", null);
        }

        private static IEnumerable<string> Folders()
        {
            var bases = new List<string>();
            var location = typeof(Loader).Assembly.Location;
            if (location.Length > 0)
            {
                bases.Add(Path.GetDirectoryName(location) ?? string.Empty);
            }
            if (!bases.Contains(AppContext.BaseDirectory.TrimEnd(Path.DirectorySeparatorChar)))
            {
                bases.Add(AppContext.BaseDirectory);
            }
            foreach (var folder in bases)
            {
                yield return folder;
            }
            foreach (var folder in bases)
            {
                foreach (var rid in Platform.RuntimeIds())
                {
                    yield return Path.Combine(folder, "runtimes", rid, "native");
                }
            }
        }

        private static PtLibLoadException Failure(string why, [AllowNull] Exception inner)
        {
            var message =
                "The native library of ptlib cannot be used" +
                (LoadedFrom.Length > 0 ? " (" + LoadedFrom + ")" : string.Empty) + ": " + why +
                ". Tried, in this order:" + Environment.NewLine + "  " +
                string.Join(Environment.NewLine + "  ", Tried) + Environment.NewLine +
                "The variable " + PathVariable + " can name the library or its folder.";
            LoadedFrom = string.Empty;
            return new PtLibLoadException(message, Tried.ToArray(), inner);
        }
    }
}
