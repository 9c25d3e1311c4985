using System.Runtime.CompilerServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>The native library.</summary>
    public static unsafe class PtLibrary
    {
        /// <summary>The version of the library, such as "0.1.0".</summary>
        /// <exception cref="PtLibLoadException">The library cannot be used.</exception>
        public static string Version
        {
            get
            {
                Loader.Ensure();
                return ReadVersion();
            }
        }

        /// <summary>The version of the C interface that the library has.</summary>
        /// <exception cref="PtLibLoadException">The library cannot be used.</exception>
        public static int AbiVersion
        {
            get
            {
                Loader.Ensure();
                return ReadAbiVersion();
            }
        }

        /// <summary>
        /// The file that was loaded; empty if the system found it by itself.
        /// </summary>
        /// <exception cref="PtLibLoadException">The library cannot be used.</exception>
        public static string LoadedFrom
        {
            get
            {
                Loader.Ensure();
                return Loader.LoadedFrom;
            }
        }

        /// <summary>
        /// Whether the library was built with a feature, such as "formats" (pictures are saved in
        /// other formats than PNG).
        /// </summary>
        /// <param name="name">The name of the feature.</param>
        /// <returns>False also for unknown names.</returns>
        /// <exception cref="PtLibLoadException">The library cannot be used.</exception>
        public static bool HasFeature(string name)
        {
            Loader.Ensure();
            return ReadFeature(name);
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static string ReadVersion()
        {
            return Utf8.Read(NativeMethods.ptl_version_string());
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static int ReadAbiVersion()
        {
            return (int)NativeMethods.ptl_abi_version();
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static bool ReadFeature(string name)
        {
            fixed (byte* text = Utf8.Of(name, nameof(name)))
            {
                return NativeMethods.ptl_has_feature(text) != 0;
            }
        }
    }
}
