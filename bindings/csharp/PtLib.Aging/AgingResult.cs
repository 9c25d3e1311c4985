using System;
using System.Diagnostics.CodeAnalysis;

namespace PtLib.Aging
{
    /// <summary>
    /// What <see cref="AgingSim.Run"/> computed; what was not asked for is null. It owns the images
    /// and the hair: dispose of it.
    /// </summary>
    public sealed class AgingResult : IDisposable
    {
        /// <summary>The ages at which hairs are lost, falling.</summary>
        [AllowNull]
        [MaybeNull]
        private float[] lossAges;

        internal AgingResult()
        {
        }

        /// <summary>Heights of wrinkles: one float for each pixel, 0 flat, 1 the highest crest.
        /// </summary>
        [AllowNull]
        [MaybeNull]
        public Image Height { get; internal set; }

        /// <summary>Normals in red, green and blue, heights in alpha: four floats.</summary>
        [AllowNull]
        [MaybeNull]
        public Image Normals { get; internal set; }

        /// <summary>The age at which hair is lost: one float, 0 where none grows, 1 where it is
        /// never lost.</summary>
        [AllowNull]
        [MaybeNull]
        public Image LossAge { get; internal set; }

        /// <summary>The picture of the head: red, green, blue and alpha of 8 bits.</summary>
        [AllowNull]
        [MaybeNull]
        public Image View { get; internal set; }

        /// <summary>The hairs that are left at the age of the settings, those that are lost last
        /// first.</summary>
        [AllowNull]
        [MaybeNull]
        public Strands Hair { get; internal set; }

        /// <summary>
        /// How many hairs there are at an age. From the age of the settings on, they are the first
        /// so many of <see cref="Hair"/>: a program draws fewer, and the head gets older. It needs
        /// no native call.
        /// </summary>
        /// <param name="age">The age, 0 to 1.</param>
        /// <returns>The number.</returns>
        /// <exception cref="InvalidOperationException">Hair was not asked for.</exception>
        /// <exception cref="ArgumentOutOfRangeException">The age is not in 0 to 1.</exception>
        public int HairsAt(double age)
        {
            if (!(age >= 0 && age <= 1))
            {
                throw new ArgumentOutOfRangeException(
                    nameof(age), age, "An age is a number from 0 to 1.");
            }
            if (lossAges == null)
            {
                throw new InvalidOperationException(
                    "Hair was not asked for: the settings' Outputs are without " +
                    nameof(AgingOutputs.Hair) + ".");
            }
            // As the block does: in single precision, and a hair is still there when it is lost.
            var single = (float)age;
            int first = 0, last = lossAges.Length;
            while (first < last)
            {
                var middle = first + ((last - first) / 2);
                if (lossAges[middle] >= single)
                {
                    first = middle + 1;
                }
                else
                {
                    last = middle;
                }
            }
            return first;
        }

        /// <summary>Gives up the images and the hair.</summary>
        public void Dispose()
        {
            Release(Height);
            Release(Normals);
            Release(LossAge);
            Release(View);
            Release(Hair);
        }

        internal void SetLossAges(float[] ages)
        {
            lossAges = ages;
        }

        private static void Release([AllowNull] IDisposable part)
        {
            if (part != null)
            {
                part.Dispose();
            }
        }
    }
}
