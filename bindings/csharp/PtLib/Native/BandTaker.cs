using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>Carries bands to a function of the caller, and what it throws back.</summary>
    internal sealed unsafe class BandTaker : IDisposable
    {
        private readonly Func<Band, bool> onBand;
        private GCHandle self;
        [AllowNull, MaybeNull]
        private ExceptionDispatchInfo thrown;

        internal BandTaker(Func<Band, bool> onBand)
        {
            this.onBand = onBand;
            self = GCHandle.Alloc(this);
        }

        internal void* UserData
        {
            get { return (void*)GCHandle.ToIntPtr(self); }
        }

        /// <summary>Called by C. Whether to go on.</summary>
        internal bool Take(NativeBand* native)
        {
            var band = new Band(*native);
            try
            {
                return onBand(band);
            }
            catch (Exception exception)
            {
                thrown = ExceptionDispatchInfo.Capture(exception);
                return false;
            }
            finally
            {
                band.End();
            }
        }

        /// <summary>Throws what the function threw.</summary>
        internal void Rethrow(IntPtr error)
        {
            if (thrown != null)
            {
                NativeMethods.ptl_error_release(error);
                thrown.Throw();
            }
        }

        public void Dispose()
        {
            self.Free();
        }
    }
}
