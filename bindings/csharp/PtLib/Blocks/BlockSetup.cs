using PtLib.Native;

namespace PtLib.Blocks
{
    /// <summary>What a computation of a block written in C# is prepared from.</summary>
    public sealed unsafe class BlockSetup
    {
        private readonly NativeParamValue[] values;
        private readonly string[] texts;

        internal BlockSetup(NativeSetup* setup)
        {
            Width = (int)setup->Width;
            Height = (int)setup->Height;
            Precision = (Precision)setup->Precision;
            Seed = setup->Seed;
            values = new NativeParamValue[setup->ValueCount];
            texts = new string[setup->ValueCount];
            for (var i = 0; i < values.Length; i++)
            {
                values[i] = *setup->Values[i];
                texts[i] = Utf8.Read(values[i].Text);
            }
        }

        /// <summary>Width of the images to make in pixels, supersampling included.</summary>
        public int Width { get; }

        /// <summary>Height of the images to make in pixels, supersampling included.</summary>
        public int Height { get; }

        /// <summary>What values are computed in: in 8 bits the engine truncates what is stored.
        /// </summary>
        public Precision Precision { get; }

        /// <summary>The seed of the block in its graph.</summary>
        public ulong Seed { get; }

        /// <summary>The value of a number, within its range.</summary>
        /// <param name="parameter">The parameter.</param>
        /// <returns>The number.</returns>
        public double GetDouble(BlockParameter parameter)
        {
            return values[parameter.Index].Number;
        }

        /// <summary>The value of a whole number, a flag (0 or 1) or a choice (its number).
        /// </summary>
        /// <param name="parameter">The parameter.</param>
        /// <returns>The number.</returns>
        public long GetInt64(BlockParameter parameter)
        {
            return values[parameter.Index].Integer;
        }

        /// <summary>The value of a flag.</summary>
        /// <param name="parameter">The parameter.</param>
        /// <returns>Whether it is set.</returns>
        public bool GetBoolean(BlockParameter parameter)
        {
            return values[parameter.Index].Integer != 0;
        }

        /// <summary>The value of a text.</summary>
        /// <param name="parameter">The parameter.</param>
        /// <returns>The text.</returns>
        public string GetText(BlockParameter parameter)
        {
            return texts[parameter.Index];
        }
    }
}
