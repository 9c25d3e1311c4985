using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>
    /// A handle during a call: it is not released before the lease ends, also when another thread
    /// disposes of it or the garbage collector has found its owner.
    /// </summary>
    internal struct Lease : IDisposable
    {
        private readonly SafeHandle owner;

        /// <summary>Takes the handle; an ObjectDisposedException if it was released.</summary>
        internal Lease(SafeHandle owner, string name)
        {
            var isTaken = false;
            try
            {
                owner.DangerousAddRef(ref isTaken);
            }
            catch (ObjectDisposedException)
            {
                throw new ObjectDisposedException(name);
            }
            this.owner = owner;
            Pointer = owner.DangerousGetHandle();
        }

        internal IntPtr Pointer { get; }

        public void Dispose()
        {
            owner.DangerousRelease();
        }
    }
}
