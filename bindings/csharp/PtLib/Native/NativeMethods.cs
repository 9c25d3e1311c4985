using System.Runtime.InteropServices;

[assembly: DefaultDllImportSearchPaths(
    DllImportSearchPath.AssemblyDirectory | DllImportSearchPath.SafeDirectories)]
#if NET8_0_OR_GREATER
[assembly: System.Runtime.CompilerServices.DisableRuntimeMarshalling]
#endif

namespace PtLib.Native
{
    /// <summary>
    /// The C interface, function by function, in the order of ptlib.h. Everything that crosses is
    /// blittable, so that no marshalling code is made: handles are IntPtr (see Lease), texts are
    /// UTF-8 with a NUL behind (see Utf8), size_t is UIntPtr.
    /// </summary>
    internal static unsafe partial class NativeMethods
    {
        /// <summary>
        /// What the loader is asked for: libptlib.dll, libptlib.so, libptlib.dylib. Not "ptlib":
        /// on Windows that is this assembly, PtLib.dll, as soon as both lie in one folder.
        /// </summary>
#if UNITY_IOS && !UNITY_EDITOR
        internal const string Library = "__Internal"; // linked into the program
#else
        internal const string Library = "libptlib";
#endif

        /// <summary>The PTL_ABI_VERSION that these declarations are of.</summary>
        internal const uint AbiVersion = 0;
    }
}
