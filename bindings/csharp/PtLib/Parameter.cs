using System.Collections.Generic;
using PtLib.Native;

namespace PtLib
{
    /// <summary>A parameter of a block type: what it holds, and what an editor has to know.
    /// </summary>
    public sealed class Parameter
    {
        internal unsafe Parameter(NativeParamInfo info)
        {
            Id = Utf8.Read(info.Id);
            Name = Utf8.Read(info.Name);
            Documentation = Utf8.Read(info.Doc);
            Unit = Utf8.Read(info.Unit);
            Kind = (ParameterKind)info.Type;
            ReadsFile = (info.Flags & 1) != 0;
            WritesFile = (info.Flags & 2) != 0;
            Minimum = info.Min;
            Maximum = info.Max;
            SoftMinimum = info.SoftMin;
            SoftMaximum = info.SoftMax;
            Step = info.Step;
            DefaultNumber = info.DefaultValue[0];
            DefaultText = Utf8.Read(info.DefaultText);
            var choices = new Choice[info.EnumCount];
            for (var i = 0; i < choices.Length; i++)
            {
                choices[i] = new Choice(Utf8.Read(info.EnumIds[i]), Utf8.Read(info.EnumDocs[i]));
            }
            Choices = choices;
        }

        /// <summary>Its id in files and in this interface.</summary>
        public string Id { get; }

        /// <summary>Its name for a user interface.</summary>
        public string Name { get; }

        /// <summary>What it does, in sentences.</summary>
        public string Documentation { get; }

        /// <summary>What its number counts, such as "px"; empty for a plain number.</summary>
        public string Unit { get; }

        /// <summary>What it holds.</summary>
        public ParameterKind Kind { get; }

        /// <summary>Whether it is the path of a file that the block reads.</summary>
        public bool ReadsFile { get; }

        /// <summary>Whether it is the path of a file that the block writes.</summary>
        public bool WritesFile { get; }

        /// <summary>The smallest value allowed.</summary>
        public double Minimum { get; }

        /// <summary>The largest value allowed.</summary>
        public double Maximum { get; }

        /// <summary>The smallest usual value: where a slider starts.</summary>
        public double SoftMinimum { get; }

        /// <summary>The largest usual value: where a slider ends.</summary>
        public double SoftMaximum { get; }

        /// <summary>Distance of neighbouring values: 1 for whole numbers, 0 for any.</summary>
        public double Step { get; }

        /// <summary>What it holds unless somebody says otherwise, if that is a number, a flag (0
        /// or 1) or a choice (its number).</summary>
        public double DefaultNumber { get; }

        /// <summary>The same as a text, for every kind.</summary>
        public string DefaultText { get; }

        /// <summary>The alternatives of a choice, in the order of their numbers.</summary>
        public IReadOnlyList<Choice> Choices { get; }
    }
}
