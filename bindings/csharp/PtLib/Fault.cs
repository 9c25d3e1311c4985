using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// One thing that is wrong: of a <see cref="PtLibException"/>, or a warning of a graph file
    /// that was read nevertheless.
    /// </summary>
    public sealed class Fault
    {
        internal unsafe Fault(NativeFault fault)
        {
            Status = (Status)fault.Status;
            Line = (int)fault.Line;
            Column = (int)fault.Column;
            BlockHandle = fault.Block;
            Parameter = Utf8.Read(fault.Param);
            Message = Utf8.Read(fault.Message);
        }

        /// <summary>What went wrong.</summary>
        public Status Status { get; }

        /// <summary>The line in the file, from 1; 0 if it concerns no place of a file.</summary>
        public int Line { get; }

        /// <summary>The column in characters, from 1; 0 if it concerns no place of a file.
        /// </summary>
        public int Column { get; }

        /// <summary>The handle of the block that it concerns (see <see cref="Block.Handle"/>);
        /// 0 if it concerns none.</summary>
        public ulong BlockHandle { get; }

        /// <summary>The id of the parameter that it concerns; empty if it concerns none.</summary>
        public string Parameter { get; }

        /// <summary>The whole message: place, fact, what is allowed, and a hint.</summary>
        public string Message { get; }

        /// <summary>The message.</summary>
        /// <returns><see cref="Message"/></returns>
        public override string ToString()
        {
            return Message;
        }
    }
}
