using System;
#if !NET8_0_OR_GREATER
using System.Runtime.InteropServices;
#endif
using PtLib.Native;

namespace PtLib.Blocks
{
    /// <summary>Tables of functions that the library offers blocks, by id.</summary>
    internal static unsafe class HostServices
    {
        // Where a table has its functions: behind its size and a reserved number.
        private const int FirstFunction = 8;

        // Where ptlp_host has get_extension: four numbers and three pointers come before it.
        private static readonly int GetExtension = 16 + (3 * IntPtr.Size);

        private static volatile bool isFound;

        /// <summary>The table of ptl.math/1; null before a block ran.</summary>
        internal static IntPtr* Math { get; private set; }

        /// <summary>The table of ptl.noise/1; null before a block ran.</summary>
        internal static IntPtr* Noise { get; private set; }

        /// <summary>Asks the host, which lives as long as the process.</summary>
        internal static void Find(IntPtr host)
        {
            if (!isFound)
            {
                Math = Table(host, "ptl.math/1");
                Noise = Table(host, "ptl.noise/1");
                isFound = true;
            }
        }

        /// <summary>A function of a table.</summary>
        internal static IntPtr Function(IntPtr* table, int index)
        {
            if (table == null)
            {
                throw new InvalidOperationException(
                    "The functions of the engine are there for blocks: in Prepare, Row, Compute.");
            }
            return table[index];
        }

        private static IntPtr* Table(IntPtr host, string id)
        {
            var function = *(IntPtr*)((byte*)host + GetExtension);
            fixed (byte* text = Utf8.Of(id, nameof(id)))
            {
#if NET8_0_OR_GREATER
                var table = ((delegate* unmanaged[Cdecl]<IntPtr, byte*, byte*>)function)(
                    host, text);
#else
                var get = (GetFunction)Marshal.GetDelegateForFunctionPointer(
                    function, typeof(GetFunction));
                var table = get(host, text);
#endif
                return table == null ? null : (IntPtr*)(table + FirstFunction);
            }
        }

#if !NET8_0_OR_GREATER
        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate byte* GetFunction(IntPtr host, byte* id);
#endif
    }
}
