using System;

namespace PtLib.Native
{
    /// <summary>
    /// Owns a ptl_value, and tells the garbage collector how much memory hangs on it.
    /// </summary>
    internal sealed class ValueHandle : NativeHandle
    {
        private readonly MemoryPressure pressure;

        internal ValueHandle(IntPtr pointer, long bytes)
            : base("PtLib.Value", pointer)
        {
            pressure = new MemoryPressure(bytes);
        }

        protected override bool ReleaseHandle()
        {
            NativeMethods.ptl_value_release(handle);
            pressure.Remove();
            return true;
        }
    }
}
