using System;

namespace PtLib.Native
{
    /// <summary>Owns a ptl_job.</summary>
    internal sealed class JobHandle : NativeHandle
    {
        internal JobHandle(IntPtr pointer)
            : base("PtLib.Job", pointer)
        {
        }

        protected override bool ReleaseHandle()
        {
            NativeMethods.ptl_job_release(handle);
            return true;
        }
    }
}
