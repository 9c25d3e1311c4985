namespace PtLib.Blocks
{
    /// <summary>A parameter that a block written in C# declared. Its value in a computation is
    /// read with <see cref="BlockSetup"/>.</summary>
    public sealed class BlockParameter
    {
        internal BlockParameter(int index, string id, string documentation, ParameterKind kind)
        {
            Index = index;
            Id = id;
            Documentation = documentation;
            Kind = kind;
        }

        /// <summary>Its id in files: lower-case words separated by single blanks, for ever.
        /// </summary>
        public string Id { get; }

        /// <summary>What it does, in sentences.</summary>
        public string Documentation { get; }

        /// <summary>What it holds.</summary>
        public ParameterKind Kind { get; }

        internal int Index { get; }

        internal double Minimum { get; set; }

        internal double Maximum { get; set; }

        internal double Default { get; set; }

        internal string DefaultText { get; set; } = string.Empty;

        internal string[] Choices { get; set; } = new string[0];
    }
}
