using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;

namespace PtLib
{
    /// <summary>
    /// A call to the library failed. The message tells what is wrong, where, and what is allowed;
    /// <see cref="Status"/> is for programs. What was cancelled throws
    /// <see cref="OperationCanceledException"/> instead.
    /// </summary>
    public sealed class PtLibException : Exception
    {
        /// <summary>Makes an error, for libraries that check what is given to this one.</summary>
        /// <param name="status">What went wrong.</param>
        /// <param name="message">Place, fact, what is allowed, and perhaps a hint.</param>
        /// <param name="parameter">The name of the argument, or empty.</param>
        public PtLibException(Status status, string message, string parameter)
            : this(status, message, 0, parameter, new Fault[0], null)
        {
        }

        internal PtLibException(
            Status status,
            string message,
            ulong blockHandle,
            string parameter,
            IReadOnlyList<Fault> faults,
            [AllowNull] Exception inner)
            : base(message, inner)
        {
            Status = status;
            BlockHandle = blockHandle;
            Parameter = parameter;
            Faults = faults;
        }

        /// <summary>What went wrong.</summary>
        public Status Status { get; }

        /// <summary>The handle of the block that it concerns (see <see cref="Block.Handle"/> and
        /// <see cref="Graph.FromHandle"/>); 0 if it concerns none.</summary>
        public ulong BlockHandle { get; }

        /// <summary>The id of the parameter, or the name of the argument, that it concerns; empty
        /// if it concerns none.</summary>
        public string Parameter { get; }

        /// <summary>All faults: a graph file may have many, other errors have one or none.
        /// </summary>
        public IReadOnlyList<Fault> Faults { get; }
    }
}
