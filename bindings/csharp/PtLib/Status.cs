namespace PtLib
{
    /// <summary>
    /// What a call came to. The numbers never change; later versions may add some.
    /// </summary>
    public enum Status
    {
        /// <summary>Done.</summary>
        Ok = 0,

        /// <summary>Not done yet: only from a job.</summary>
        Pending = 1,

        /// <summary>The caller asked to stop.</summary>
        Cancelled = 2,

        /// <summary>An argument makes no sense; the message names it.</summary>
        InvalidArgument = 3,

        /// <summary>This version or build cannot do that.</summary>
        Unsupported = 4,

        /// <summary>The system has no memory left.</summary>
        NoMemory = 5,

        /// <summary>Another thread is changing the object.</summary>
        Busy = 6,

        /// <summary>No block, parameter, port or type of that name.</summary>
        NotFound = 7,

        /// <summary>The block was removed from its graph, or never was in it.</summary>
        StaleHandle = 8,

        /// <summary>A value or a connection of the wrong kind.</summary>
        TypeMismatch = 9,

        /// <summary>The connection would make a block depend on itself.</summary>
        Cycle = 10,

        /// <summary>A required input is not connected.</summary>
        Unconnected = 11,

        /// <summary>A number outside its range.</summary>
        OutOfRange = 12,

        /// <summary>A text or file that does not follow its grammar.</summary>
        Parse = 13,

        /// <summary>A file could not be read or written.</summary>
        Io = 14,

        /// <summary>More than the limits of the engine allow.</summary>
        Limit = 15,

        /// <summary>The caller's buffer is too small; the message says what is needed.</summary>
        BufferTooSmall = 16,

        /// <summary>The file policy forbids it; the message says how to allow it.</summary>
        Denied = 17,

        /// <summary>
        /// The system cannot load the file of a plug-in: it is no library, or misses
        /// another one.
        /// </summary>
        PluginLoad = 20,

        /// <summary>The plug-in was built for another version of the plug-in contract.</summary>
        PluginAbi = 21,

        /// <summary>Another plug-in has block types of that id.</summary>
        PluginDuplicate = 22,

        /// <summary>A block of a plug-in panicked or threw an exception.</summary>
        PluginPanic = 23,

        /// <summary>The tables of a Rust plug-in are laid out in another way than here.</summary>
        PluginLayout = 24,

        /// <summary>The file is a library, but no plug-in.</summary>
        PluginSymbol = 25,

        /// <summary>The plug-in could not be initialised.</summary>
        PluginInit = 26,

        /// <summary>The plug-in describes itself wrongly; the message names the field.</summary>
        PluginDescriptor = 27,

        /// <summary>A block of a plug-in says that it failed.</summary>
        PluginFailed = 28,

        /// <summary>A defect of this library or of a block. The program may go on.</summary>
        Internal = 99,
    }
}
