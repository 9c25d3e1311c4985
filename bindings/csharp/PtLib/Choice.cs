namespace PtLib
{
    /// <summary>One alternative of a parameter that is a choice.</summary>
    public sealed class Choice
    {
        internal Choice(string id, string documentation)
        {
            Id = id;
            Documentation = documentation;
        }

        /// <summary>Its id in files and in this interface.</summary>
        public string Id { get; }

        /// <summary>What it means.</summary>
        public string Documentation { get; }
    }
}
