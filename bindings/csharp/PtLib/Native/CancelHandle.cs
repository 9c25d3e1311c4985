using System;

namespace PtLib.Native
{
    /// <summary>Owns a ptl_cancel.</summary>
    internal sealed class CancelHandle : NativeHandle
    {
        internal CancelHandle(IntPtr pointer)
            : base("PtLib.Cancel", pointer)
        {
        }

        protected override bool ReleaseHandle()
        {
            NativeMethods.ptl_cancel_release(handle);
            return true;
        }
    }
}
