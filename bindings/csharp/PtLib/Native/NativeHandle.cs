using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>A handle of the library, released once: by Dispose or by the finalizer.</summary>
    internal abstract class NativeHandle : SafeHandle
    {
        private readonly string name;

        protected NativeHandle(string name, IntPtr pointer)
            : base(IntPtr.Zero, true)
        {
            this.name = name;
            SetHandle(pointer);
        }

        public override bool IsInvalid
        {
            get { return handle == IntPtr.Zero; }
        }

        /// <summary>The handle for a call.</summary>
        internal Lease Use()
        {
            return new Lease(this, name);
        }
    }
}
