using System;
using System.Diagnostics.CodeAnalysis;
using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// A computation on a thread of the library. Disposing of it cancels it if it has not ended.
    /// Any thread may ask how far it is; one at a time waits.
    /// </summary>
    public sealed unsafe class Job : IDisposable
    {
        private readonly JobHandle handle;

        internal Job(IntPtr job)
        {
            handle = new JobHandle(job);
        }

        /// <summary>Whether it has ended, well or not.</summary>
        public bool IsDone
        {
            get
            {
                using (var job = handle.Use())
                {
                    var status = NativeMethods.ptl_job_poll(job.Pointer, null);
                    return IsOver(status);
                }
            }
        }

        /// <summary>What part is done, 0 to 1.</summary>
        public double Progress
        {
            get
            {
                var progress = new NativeProgress { StructSize = (uint)sizeof(NativeProgress) };
                using (var job = handle.Use())
                {
                    IsOver(NativeMethods.ptl_job_poll(job.Pointer, &progress));
                }
                return progress.Fraction;
            }
        }

        /// <summary>Waits for the image.</summary>
        /// <returns>The image; dispose of it.</returns>
        /// <exception cref="PtLibException">The computation failed.</exception>
        public Image Wait()
        {
            // Without a timeout the library waits as long as it takes.
            return Wait(-1) ?? throw new InvalidOperationException();
        }

        /// <summary>Waits for the image for some time.</summary>
        /// <param name="timeout">How long.</param>
        /// <returns>The image, to be disposed of; null if it is not done.</returns>
        /// <exception cref="PtLibException">The computation failed.</exception>
        [return: MaybeNull]
        public Image Wait(TimeSpan timeout)
        {
            return Wait((long)Math.Max(0, Math.Ceiling(timeout.TotalMilliseconds)));
        }

        /// <summary>Cancels it if it has not ended, and waits for its thread. Images that it gave
        /// stay valid.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }

        [return: MaybeNull]
        private Image Wait(long milliseconds)
        {
            IntPtr image, error;
            using (var job = handle.Use())
            {
                var status =
                    NativeMethods.ptl_job_wait(job.Pointer, milliseconds, &image, &error);
                if (status == (int)Status.Pending)
                {
                    return null;
                }
                Errors.Check(status, error);
            }
            return new Image(image);
        }

        private static bool IsOver(int status)
        {
            if (status == (int)Status.Pending)
            {
                return false;
            }
            Errors.Check(status, IntPtr.Zero);
            return true;
        }
    }
}
