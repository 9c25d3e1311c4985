using System;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>Arrays that the library reads where they are: pinned until it says so.</summary>
    internal sealed class Loan
    {
        private readonly GCHandle[] pins;

        internal Loan(GCHandle[] pins)
        {
            this.pins = pins;
        }

        internal void End()
        {
            foreach (var pin in pins)
            {
                if (pin.IsAllocated)
                {
                    pin.Free();
                }
            }
        }
    }
}
