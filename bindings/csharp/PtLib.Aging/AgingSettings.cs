using System.Diagnostics.CodeAnalysis;

namespace PtLib.Aging
{
    /// <summary>
    /// How a head ages. Everything has a default: that of its block, if nothing else is said.
    /// Numbers are checked when they are used.
    /// </summary>
    public sealed class AgingSettings
    {
        /// <summary>The age, from 0 (all hair, no wrinkles) to 1.</summary>
        public double Age { get; set; } = 0.5;

        /// <summary>Width and height of textures and of the picture in pixels.</summary>
        public int Size { get; set; } = 1024;

        /// <summary>Another seed, other hair.</summary>
        public ulong Seed { get; set; }

        /// <summary>The muscles whose wrinkles there are, as the block "aging.wrinkle map" reads
        /// them; null for its default, two muscles on the forehead, empty for none.</summary>
        [AllowNull]
        [MaybeNull]
        public string Muscles { get; set; }

        /// <summary>How many hairs the whole mesh would have if hair grew everywhere.</summary>
        public int Hairs { get; set; } = 100000;

        /// <summary>The colour of the skin in the picture; null for one colour.</summary>
        [AllowNull]
        [MaybeNull]
        public ImageSource SkinColor { get; set; }

        /// <summary>Where and how much wrinkles grow, 0 to 1; null: everywhere in full.</summary>
        [AllowNull]
        [MaybeNull]
        public ImageSource WrinkleMask { get; set; }

        /// <summary>Heights of fine wrinkles, a tile that is repeated; null: there are none.
        /// </summary>
        [AllowNull]
        [MaybeNull]
        public ImageSource FineTile { get; set; }

        /// <summary>Where and how much fine wrinkles grow, 0 to 1; null: everywhere in full.
        /// </summary>
        [AllowNull]
        [MaybeNull]
        public ImageSource FineMask { get; set; }

        /// <summary>Where hair grows in youth, white. Null: on the skull of a head whose texture
        /// coordinates are those of a sphere around it, with the face in the middle.</summary>
        [AllowNull]
        [MaybeNull]
        public ImageSource OuterHair { get; set; }

        /// <summary>Where hair still grows in old age, white; only inside of
        /// <see cref="OuterHair"/>. Null: around the back of such a head, from ear to ear.
        /// </summary>
        [AllowNull]
        [MaybeNull]
        public ImageSource InnerHair { get; set; }

        /// <summary>What is computed.</summary>
        public AgingOutputs Outputs { get; set; } = AgingOutputs.All;
    }
}
