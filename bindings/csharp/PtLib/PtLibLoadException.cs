using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;

namespace PtLib
{
    /// <summary>
    /// The native library was not found, or is one of another version. The message lists every
    /// path that was tried and what came of it.
    /// </summary>
    public sealed class PtLibLoadException : Exception
    {
        internal PtLibLoadException(
            string message, IReadOnlyList<string> tried, [AllowNull] Exception inner)
            : base(message, inner)
        {
            PathsTried = tried;
        }

        /// <summary>The paths that were tried, in their order.</summary>
        public IReadOnlyList<string> PathsTried { get; }
    }
}
