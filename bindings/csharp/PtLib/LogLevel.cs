namespace PtLib
{
    /// <summary>How much a message of the log matters.</summary>
    public enum LogLevel
    {
        /// <summary>Details for whoever looks for a fault.</summary>
        Debug = 1,

        /// <summary>What goes on.</summary>
        Info = 2,

        /// <summary>What works, but probably not as meant.</summary>
        Warning = 3,

        /// <summary>What failed.</summary>
        Error = 4,
    }
}
