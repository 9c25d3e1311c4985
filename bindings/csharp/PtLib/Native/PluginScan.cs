using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;
using System.Runtime.ExceptionServices;

namespace PtLib.Native
{
    /// <summary>What a search for plug-ins finds.</summary>
    internal sealed unsafe class PluginScan
    {
        [AllowNull, MaybeNull]
        private readonly Func<Plugin, bool> report;
        [AllowNull, MaybeNull]
        private ExceptionDispatchInfo thrown;

        internal PluginScan([AllowNull] Func<Plugin, bool> report)
        {
            this.report = report;
        }

        internal List<Plugin> Found { get; } = new List<Plugin>();

        /// <summary>Called by C. Whether to go on.</summary>
        internal bool Report(NativeScanReport* native)
        {
            try
            {
                var plugin = new Plugin(*native);
                Found.Add(plugin);
                return report == null || report(plugin);
            }
            catch (Exception exception)
            {
                thrown = ExceptionDispatchInfo.Capture(exception);
                return false;
            }
        }

        /// <summary>Throws what the search came to; that the report ended it is no error.</summary>
        internal void Check(int status, IntPtr error)
        {
            if (thrown != null)
            {
                NativeMethods.ptl_error_release(error);
                thrown.Throw();
            }
            if (status == (int)Status.Cancelled)
            {
                NativeMethods.ptl_error_release(error);
                return;
            }
            Errors.Check(status, error);
        }
    }
}
