using System;

namespace PtLib.Native
{
    /// <summary>Owns a ptl_engine.</summary>
    internal sealed class EngineHandle : NativeHandle
    {
        internal EngineHandle(IntPtr pointer)
            : base("PtLib.Engine", pointer)
        {
        }

        protected override bool ReleaseHandle()
        {
            NativeMethods.ptl_engine_release(handle);
            return true;
        }
    }
}
