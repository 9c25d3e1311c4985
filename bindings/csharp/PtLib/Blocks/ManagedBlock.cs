using System.Collections.Generic;

namespace PtLib.Blocks
{
    /// <summary>
    /// A block type written in C#: derive from <see cref="RowBlock{TState}"/> or
    /// <see cref="ImageBlock{TState}"/>, declare parameters and inputs in the constructor, and
    /// add it to an engine with a <see cref="ManagedPlugin"/>.
    /// <para>
    /// Its result may depend on parameters, seed, size, precision and inputs only, not on threads
    /// or time. It runs on the threads of the engine, on several at once. What it throws ends the
    /// computation: the <see cref="PtLibException"/> of that has it as inner exception.
    /// </para>
    /// </summary>
    public abstract class ManagedBlock
    {
        internal ManagedBlock(string id, string documentation)
        {
            Id = id;
            Documentation = documentation;
        }

        /// <summary>Its id: "vendor.name", lower-case words separated by single blanks, for ever.
        /// </summary>
        public string Id { get; }

        /// <summary>What it makes, in one sentence.</summary>
        public string Documentation { get; }

        /// <summary>The family that it is listed with; "managed" unless it says otherwise.
        /// </summary>
        public string Category { get; protected set; } = "managed";

        /// <summary>The version of the block type: counts up whenever its results change.
        /// </summary>
        public int Version { get; protected set; } = 1;

        /// <summary>Whether another seed gives another result.</summary>
        public bool UsesSeed { get; protected set; }

        /// <summary>Channels of its output: 1, 3 or 4.</summary>
        public int OutputChannels { get; protected set; } = 1;

        /// <summary>Whether its output is any finite numbers, not only 0 to 1.</summary>
        public bool HasFreeRange { get; protected set; }

        /// <summary>Why its output need not tile although its inputs do; empty if it always
        /// tiles.</summary>
        public string TilingException { get; protected set; } = string.Empty;

        internal List<BlockParameter> Parameters { get; } = new List<BlockParameter>();

        internal List<KeyValuePair<string, bool>> Inputs { get; } =
            new List<KeyValuePair<string, bool>>();

        internal abstract uint Shape { get; }

        /// <summary>Declares an input for an image.</summary>
        /// <param name="id">Its id.</param>
        /// <param name="isOptional">Whether the block works without it.</param>
        /// <returns>Its number, for <see cref="BlockCall.Input"/>.</returns>
        protected int AddInput(string id, bool isOptional = false)
        {
            Inputs.Add(new KeyValuePair<string, bool>(id, isOptional));
            return Inputs.Count - 1;
        }

        /// <summary>Declares a number.</summary>
        /// <param name="id">Its id.</param>
        /// <param name="documentation">What it does, in sentences.</param>
        /// <param name="minimum">The smallest value allowed.</param>
        /// <param name="maximum">The largest value allowed.</param>
        /// <param name="defaultValue">What it holds unless somebody says otherwise.</param>
        /// <returns>The parameter.</returns>
        protected BlockParameter AddNumber(
            string id, string documentation, double minimum, double maximum, double defaultValue)
        {
            var parameter = Add(id, documentation, ParameterKind.Number);
            parameter.Minimum = minimum;
            parameter.Maximum = maximum;
            parameter.Default = defaultValue;
            return parameter;
        }

        /// <summary>Declares a whole number.</summary>
        /// <param name="id">Its id.</param>
        /// <param name="documentation">What it does, in sentences.</param>
        /// <param name="minimum">The smallest value allowed.</param>
        /// <param name="maximum">The largest value allowed.</param>
        /// <param name="defaultValue">What it holds unless somebody says otherwise.</param>
        /// <returns>The parameter.</returns>
        protected BlockParameter AddInteger(
            string id, string documentation, int minimum, int maximum, int defaultValue)
        {
            var parameter = Add(id, documentation, ParameterKind.Integer);
            parameter.Minimum = minimum;
            parameter.Maximum = maximum;
            parameter.Default = defaultValue;
            return parameter;
        }

        /// <summary>Declares a flag.</summary>
        /// <param name="id">Its id.</param>
        /// <param name="documentation">What it does, in sentences.</param>
        /// <param name="defaultValue">What it holds unless somebody says otherwise.</param>
        /// <returns>The parameter.</returns>
        protected BlockParameter AddFlag(string id, string documentation, bool defaultValue)
        {
            var parameter = Add(id, documentation, ParameterKind.Flag);
            parameter.Maximum = 1;
            parameter.Default = defaultValue ? 1 : 0;
            return parameter;
        }

        /// <summary>Declares a choice.</summary>
        /// <param name="id">Its id.</param>
        /// <param name="documentation">What it does, in sentences.</param>
        /// <param name="defaultValue">The number of the alternative that it holds unless somebody
        /// says otherwise.</param>
        /// <param name="choices">The ids of the alternatives; the list only grows at its end.
        /// </param>
        /// <returns>The parameter.</returns>
        protected BlockParameter AddChoice(
            string id, string documentation, int defaultValue, params string[] choices)
        {
            var parameter = Add(id, documentation, ParameterKind.Choice);
            parameter.Choices = choices;
            parameter.Maximum = choices.Length - 1;
            parameter.Default = defaultValue;
            return parameter;
        }

        /// <summary>Declares a text.</summary>
        /// <param name="id">Its id.</param>
        /// <param name="documentation">What it does, in sentences.</param>
        /// <param name="defaultValue">What it holds unless somebody says otherwise.</param>
        /// <returns>The parameter.</returns>
        protected BlockParameter AddText(string id, string documentation, string defaultValue)
        {
            var parameter = Add(id, documentation, ParameterKind.Text);
            parameter.DefaultText = defaultValue;
            return parameter;
        }

        internal abstract object PrepareState(BlockSetup setup);

        internal abstract void ComputeWith(object state, BlockCall call);

        private BlockParameter Add(string id, string documentation, ParameterKind kind)
        {
            var parameter = new BlockParameter(Parameters.Count, id, documentation, kind);
            Parameters.Add(parameter);
            return parameter;
        }
    }
}
