using System;
#if !NET8_0_OR_GREATER && !UNITY_5_3_OR_NEWER
using System.IO;
using System.Runtime.CompilerServices;
#endif
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>Makes a file the library that <see cref="NativeMethods"/> calls.</summary>
    internal static unsafe class NativeImage
    {
#if NET8_0_OR_GREATER
        private static string chosen = string.Empty;
        private static bool isBound;

        /// <summary>Whether the file is what will be loaded.</summary>
        internal static bool Bind(string file)
        {
            chosen = file;
            try
            {
                if (!isBound)
                {
                    NativeLibrary.SetDllImportResolver(typeof(NativeImage).Assembly, Resolve);
                    isBound = true;
                }
            }
            catch (InvalidOperationException)
            {
                // The program has set a resolver of its own for this assembly: it decides.
            }
            return isBound;
        }

        private static IntPtr Resolve(
            string name, System.Reflection.Assembly assembly, DllImportSearchPath? search)
        {
            return name == NativeMethods.Library ? NativeLibrary.Load(chosen) : IntPtr.Zero;
        }
#elif UNITY_5_3_OR_NEWER
        /// <summary>No: Unity finds libraries by its own rules.</summary>
        internal static bool Bind(string file)
        {
            return false;
        }
#else
        /// <summary>Whether the file is what will be loaded.</summary>
        internal static bool Bind(string file)
        {
            try
            {
                if (Platform.IsWindows)
                {
                    // A library that is loaded is found by its name from then on, but only by that.
                    return Path.GetFileNameWithoutExtension(file) == NativeMethods.Library &&
                        LoadLibrary(file);
                }
                if (Platform.IsMono)
                {
                    Map(file);
                    return true;
                }
            }
            catch (EntryPointNotFoundException)
            {
                // A mono inside another program may hide it.
            }
            return false;
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static void Map(string file)
        {
            fixed (byte* name = Utf8.Of(NativeMethods.Library, nameof(file)))
            fixed (byte* target = Utf8.Of(file, nameof(file)))
            {
                mono_dllmap_insert(IntPtr.Zero, name, null, target, null);
            }
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static bool LoadLibrary(string file)
        {
            fixed (char* name = file)
            {
                return LoadLibraryW(name) != IntPtr.Zero;
            }
        }

        [DllImport("__Internal", CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]
        private static extern void mono_dllmap_insert(
            IntPtr assembly, byte* name, byte* function, byte* target, byte* targetFunction);

        [DllImport("kernel32", ExactSpelling = true)]
        private static extern IntPtr LoadLibraryW(char* file);
#endif
    }
}
