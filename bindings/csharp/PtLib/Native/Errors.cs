using System;
using System.Collections.Generic;
using System.Threading;

namespace PtLib.Native
{
    /// <summary>Makes exceptions of statuses.</summary>
    internal static unsafe class Errors
    {
        /// <summary>
        /// Throws unless the status is PTL_OK. The error, which may be NULL, is released.
        /// </summary>
        internal static void Check(int status, IntPtr error)
        {
            Check(status, error, CancellationToken.None);
        }

        /// <summary>The same for calls that a token may have cancelled.</summary>
        internal static void Check(int status, IntPtr error, CancellationToken token)
        {
            if (status == (int)Status.Ok)
            {
                return;
            }
            Exception exception;
            try
            {
                exception = Of((Status)status, error, token);
            }
            finally
            {
                NativeMethods.ptl_error_release(error);
            }
            throw exception;
        }

        private static Exception Of(Status status, IntPtr error, CancellationToken token)
        {
            var message = error != IntPtr.Zero
                ? Utf8.Read(NativeMethods.ptl_error_message(error))
                : Utf8.Read(NativeMethods.ptl_status_name((int)status));
            if (status == Status.Cancelled)
            {
                return new OperationCanceledException(message, token);
            }
            return new PtLibException(
                status,
                message,
                NativeMethods.ptl_error_block(error),
                Utf8.Read(NativeMethods.ptl_error_param(error)),
                Faults(error),
                Blocks.ManagedFailures.Find(status, message));
        }

        private static Fault[] Faults(IntPtr error)
        {
            var faults = new List<Fault>();
            var count = NativeMethods.ptl_error_fault_count(error);
            for (uint i = 0; i < count; i++)
            {
                var native = new NativeFault { StructSize = (uint)sizeof(NativeFault) };
                if (NativeMethods.ptl_error_fault_at(error, i, &native) == (int)Status.Ok)
                {
                    faults.Add(new Fault(native));
                }
            }
            return faults.ToArray();
        }
    }
}
