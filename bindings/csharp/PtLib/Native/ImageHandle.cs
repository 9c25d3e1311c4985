using System;

namespace PtLib.Native
{
    /// <summary>
    /// Owns a ptl_image, and tells the garbage collector how much memory hangs on it.
    /// </summary>
    internal sealed class ImageHandle : NativeHandle
    {
        private readonly MemoryPressure pressure;

        internal ImageHandle(IntPtr pointer, long bytes)
            : base("PtLib.Image", pointer)
        {
            pressure = new MemoryPressure(bytes);
        }

        protected override bool ReleaseHandle()
        {
            NativeMethods.ptl_image_release(handle);
            pressure.Remove();
            return true;
        }
    }
}
