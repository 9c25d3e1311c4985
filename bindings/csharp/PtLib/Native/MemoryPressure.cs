using System;
using System.Threading;

namespace PtLib.Native
{
    /// <summary>Memory of the library that the garbage collector should feel.</summary>
    internal struct MemoryPressure
    {
        /// <summary>On mono: memory of the library after which garbage is collected.</summary>
        private const long Budget = 128 << 20;

        private static long sinceCollection;

        private readonly long bytes;

        internal MemoryPressure(long bytes)
        {
            this.bytes = bytes;
            if (bytes > 0)
            {
                GC.AddMemoryPressure(bytes);
                if (Platform.IsMono)
                {
                    Collect(bytes);
                }
            }
        }

        // mono takes note of the pressure and does nothing about it.
        private static void Collect(long bytes)
        {
            if (Interlocked.Add(ref sinceCollection, bytes) > Budget)
            {
                Interlocked.Exchange(ref sinceCollection, 0);
                GC.Collect();
            }
        }

        internal void Remove()
        {
            if (bytes > 0)
            {
                GC.RemoveMemoryPressure(bytes);
            }
        }
    }
}
