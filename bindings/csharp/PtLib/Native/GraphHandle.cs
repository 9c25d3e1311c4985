using System;

namespace PtLib.Native
{
    /// <summary>Owns a ptl_graph.</summary>
    internal sealed class GraphHandle : NativeHandle
    {
        internal GraphHandle(IntPtr pointer)
            : base("PtLib.Graph", pointer)
        {
        }

        protected override bool ReleaseHandle()
        {
            NativeMethods.ptl_graph_release(handle);
            return true;
        }
    }
}
