using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>An array that stays where it is for a call.</summary>
    internal struct Pinned<T> : IDisposable
        where T : struct
    {
        private GCHandle pin;

        internal Pinned(T[] array, string parameter)
        {
            if (array == null)
            {
                throw new PtLibException(
                    Status.InvalidArgument, parameter + " is null, an array is needed.", parameter);
            }
            pin = Pin(array, parameter);
            Address = pin.AddrOfPinnedObject();
            Bytes = (long)array.Length * Blittable<T>.Size;
        }

        internal IntPtr Address { get; }

        internal long Bytes { get; }

        /// <summary>Pins an array whose elements are bits only.</summary>
        internal static GCHandle Pin(T[] array, string parameter)
        {
            try
            {
                if (Blittable<T>.IsBitsOnly)
                {
                    return GCHandle.Alloc(array, GCHandleType.Pinned);
                }
            }
            catch (ArgumentException)
            {
                // Structs with bool or char are refused by the runtime.
            }
            throw new ArgumentException(
                typeof(T) + " holds references, or bool or char; it needs to be made of numbers " +
                "only.", parameter);
        }

        public void Dispose()
        {
            if (pin.IsAllocated)
            {
                pin.Free();
            }
        }
    }
}
