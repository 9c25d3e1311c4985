using System;
using System.Runtime.InteropServices;
#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
#endif

namespace PtLib.Native
{
    /// <summary>
    /// The functions that C calls: one for each signature, static, with a GCHandle as user data.
    /// No exception leaves them.
    /// </summary>
    internal static unsafe class Callbacks
    {
#if NET8_0_OR_GREATER
        internal static readonly IntPtr Progress =
            (IntPtr)(delegate* unmanaged[Cdecl]<NativeProgress*, IntPtr, int>)&OnProgress;

        internal static readonly IntPtr Band =
            (IntPtr)(delegate* unmanaged[Cdecl]<NativeBand*, IntPtr, int>)&OnBand;

        internal static readonly IntPtr Log =
            (IntPtr)(delegate* unmanaged[Cdecl]<int, byte*, IntPtr, void>)&OnLog;

        internal static readonly IntPtr Scan =
            (IntPtr)(delegate* unmanaged[Cdecl]<NativeScanReport*, IntPtr, int>)&OnScan;

        internal static readonly IntPtr Free =
            (IntPtr)(delegate* unmanaged[Cdecl]<IntPtr, void>)&OnFree;
#else
        internal static readonly IntPtr Progress;
        internal static readonly IntPtr Band;
        internal static readonly IntPtr Log;
        internal static readonly IntPtr Scan;
        internal static readonly IntPtr Free;

        // The delegates live as long as the process, and so do the functions made of them.
        private static readonly ProgressFunction ProgressDelegate = OnProgress;
        private static readonly BandFunction BandDelegate = OnBand;
        private static readonly LogFunction LogDelegate = OnLog;
        private static readonly ScanFunction ScanDelegate = OnScan;
        private static readonly FreeFunction FreeDelegate = OnFree;

        static Callbacks()
        {
            Progress = Marshal.GetFunctionPointerForDelegate(ProgressDelegate);
            Band = Marshal.GetFunctionPointerForDelegate(BandDelegate);
            Log = Marshal.GetFunctionPointerForDelegate(LogDelegate);
            Scan = Marshal.GetFunctionPointerForDelegate(ScanDelegate);
            Free = Marshal.GetFunctionPointerForDelegate(FreeDelegate);
        }

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int ProgressFunction(NativeProgress* progress, IntPtr userData);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int BandFunction(NativeBand* band, IntPtr userData);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate void LogFunction(int level, byte* message, IntPtr userData);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int ScanFunction(NativeScanReport* report, IntPtr userData);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate void FreeFunction(IntPtr userData);
#endif

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(ProgressFunction))]
#endif
        private static int OnProgress(NativeProgress* progress, IntPtr userData)
        {
            return Target<Watcher>(userData).Report(progress->Fraction) ? 0 : 1;
        }

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(BandFunction))]
#endif
        private static int OnBand(NativeBand* band, IntPtr userData)
        {
            return Target<BandTaker>(userData).Take(band) ? 0 : 1;
        }

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(LogFunction))]
#endif
        private static void OnLog(int level, byte* message, IntPtr userData)
        {
            try
            {
                Target<Action<LogLevel, string>>(userData)((LogLevel)level, Utf8.Read(message));
            }
            catch (Exception)
            {
                // Nobody waits for it.
            }
        }

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(ScanFunction))]
#endif
        private static int OnScan(NativeScanReport* report, IntPtr userData)
        {
            return Target<PluginScan>(userData).Report(report) ? 0 : 1;
        }

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(FreeFunction))]
#endif
        private static void OnFree(IntPtr userData)
        {
            var handle = GCHandle.FromIntPtr(userData);
            var loan = handle.Target as Loan;
            handle.Free();
            loan?.End();
        }

        private static T Target<T>(IntPtr userData)
            where T : class
        {
            return (T)(GCHandle.FromIntPtr(userData).Target ??
                throw new InvalidOperationException());
        }
    }
}
