using System;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Threading;

namespace PtLib.Native
{
    /// <summary>
    /// Carries the caller's progress and token through a computation: makes C options that lead
    /// here, keeps what the progress threw, and frees what C needed.
    /// </summary>
    internal sealed unsafe class Watcher : IDisposable
    {
        [AllowNull, MaybeNull]
        private readonly IProgress<double> progress;
        private readonly CancellationToken token;
        [AllowNull, MaybeNull]
        private readonly CancelHandle cancel;
        private readonly CancellationTokenRegistration registration;
        private GCHandle self;
        [AllowNull, MaybeNull]
        private ExceptionDispatchInfo thrown;

        internal Watcher([AllowNull] IProgress<double> progress, CancellationToken token)
        {
            this.progress = progress;
            this.token = token;
            token.ThrowIfCancellationRequested();
            if (progress != null)
            {
                self = GCHandle.Alloc(this);
            }
            if (token.CanBeCanceled)
            {
                var handle = NewCancel();
                cancel = handle;
                registration = token.Register(Request, handle);
            }
        }

        /// <summary>The C options; this must live until they are used no longer.</summary>
        internal NativeComputeOptions Prepare([AllowNull] ComputeOptions options)
        {
            var native = (options ?? ComputeOptions.Default).ToNative();
            native.Cancel = cancel == null ? IntPtr.Zero : cancel.DangerousGetHandle();
            if (progress != null)
            {
                native.Progress = Callbacks.Progress;
                native.UserData = (void*)GCHandle.ToIntPtr(self);
            }
            return native;
        }

        /// <summary>Called by C. Whether to go on.</summary>
        internal bool Report(double fraction)
        {
            try
            {
                progress?.Report(fraction);
                return true;
            }
            catch (Exception exception)
            {
                thrown = ExceptionDispatchInfo.Capture(exception);
                return false;
            }
        }

        /// <summary>
        /// Throws what the call came to: what the progress threw, or what the status says.
        /// </summary>
        internal void Check(int status, IntPtr error)
        {
            if (thrown != null)
            {
                NativeMethods.ptl_error_release(error);
                thrown.Throw();
            }
            Errors.Check(status, error, token);
        }

        public void Dispose()
        {
            // Waits for a request that runs: from then on nobody uses the handle.
            registration.Dispose();
            cancel?.Dispose();
            if (self.IsAllocated)
            {
                self.Free();
            }
        }

        private static CancelHandle NewCancel()
        {
            IntPtr handle, error;
            var status = NativeMethods.ptl_cancel_create(&handle, &error);
            Errors.Check(status, error);
            return new CancelHandle(handle);
        }

        private static void Request([AllowNull] object state)
        {
            var handle = (CancelHandle)(state ?? throw new ArgumentNullException(nameof(state)));
            using (var cancel = handle.Use())
            {
                NativeMethods.ptl_cancel_request(cancel.Pointer);
            }
        }
    }
}
