using System;
using PtLib.Blocks;

namespace ManagedBlockSample
{
    /// <summary>Checks, whose edges an input moves.</summary>
    internal sealed class Checks : RowBlock<Checks.Settings>
    {
        private readonly int shift;
        private readonly BlockParameter number;
        private readonly BlockParameter warp;

        public Checks()
            : base("sample.checks", "Makes checks, whose edges an image moves.")
        {
            Category = "patterns";
            shift = AddInput("shift", isOptional: true);
            number = AddInteger("number", "Pairs of checks across the image.", 1, 100, 4);
            warp = AddNumber("warp", "How far white moves an edge, in checks.", 0, 1, 0.25);
        }

        protected override Settings Prepare(BlockSetup setup)
        {
            return new Settings
            {
                Checks = 2 * (int)setup.GetInt64(number),
                Warp = (float)setup.GetDouble(warp),
            };
        }

        protected override void Row(Settings settings, BlockCall call, int row)
        {
            var output = call.Output;
            var input = call.Input(shift);
            var samples = output.Row(0, row);
            var down = (float)(output.Y + row) / output.ImageHeight * settings.Checks;
            for (var x = 0; x < samples.Length; x++)
            {
                var across = (float)(output.X + x) / output.ImageWidth * settings.Checks;
                var moved = input.IsPresent ? settings.Warp * input.Row(0, row)[x] : 0;
                var check = (int)Math.Floor(across + moved) + (int)Math.Floor(down + moved);
                samples[x] = check % 2 == 0 ? 0 : 1;
            }
        }

        /// <summary>The values of the parameters.</summary>
        internal sealed class Settings
        {
            public int Checks { get; set; }

            public float Warp { get; set; }
        }
    }
}
