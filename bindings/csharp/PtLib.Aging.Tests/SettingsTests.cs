using System;
using System.IO;
using System.Linq;
using PtLib.Tests;

namespace PtLib.Aging.Tests
{
    /// <summary>Settings, and pictures of every source.</summary>
    internal static class SettingsTests
    {
        internal static void Run(Runner runner)
        {
            runner.Run("settings: out of range", OutOfRange);
            runner.Run("settings: muscles", Muscles);
            runner.Run("settings: pictures of numbers", Numbers);
            runner.Run("settings: wrong pictures", WrongPictures);
            runner.Run("settings: numbers, images and files give the same", Files);
            runner.Run("settings: fine wrinkles, with a mask", Fine);
            runner.Run("settings: the colour of the skin", SkinColor);
            runner.Run("settings: regions of hair", Regions);
        }

        private static void OutOfRange()
        {
            foreach (var age in new[] { -0.01, 1.01, double.NaN, double.PositiveInfinity })
            {
                var error = Fails(Status.OutOfRange, settings => settings.Age = age);
                Assert.Equal("age", error.Parameter);
            }
            Assert.Equal("hairs", Fails(Status.OutOfRange, all => all.Hairs = -1).Parameter);
            Fails(Status.OutOfRange, settings => settings.Size = 0);
        }

        private static void Muscles()
        {
            var error = Fails(
                Status.Parse, settings => settings.Muscles = "! ma=.3;.7 mb=.3;.6 n=x");
            Assert.Contains("muscles", error.Message);
            var flat = Ball.Small(AgingOutputs.Height);
            flat.Muscles = string.Empty;
            Assert.True(Heights(flat).All(height => height == 0), "no muscle, no wrinkle");
            flat.Muscles = "! ma=.2;.5 mb=.8;.5 n=3";
            Assert.True(Heights(flat).Any(height => height > 0.4f), "wrinkles of that muscle");
        }

        private static void Numbers()
        {
            var settings = Ball.Small(AgingOutputs.Height);
            var full = Heights(settings);
            settings.WrinkleMask = new float[4];
            Assert.True(Heights(settings).All(height => height == 0), "nothing under a mask of 0");
            settings.WrinkleMask = ImageSource.FromPixels(new[] { 1f, 1f, 1f, 1f, 1f, 1f }, 3, 2);
            Assert.Same(full, Heights(settings));
            settings.WrinkleMask = ImageSource.FromPixels(new[] { 1f, 0.5f, 0f }, 1, 1);
            Assert.Equal(full.Length, Heights(settings).Length);
            Take((string)null);
            Take((float[])null);
            Take((Image)null);
        }

        private static void WrongPictures()
        {
            Assert.Contains(
                "3 numbers",
                Assert.Fails(Status.InvalidArgument, () => Take(new float[3])).Message);
            Assert.Fails(Status.InvalidArgument, () => Take(new float[0]));
            Assert.Fails(
                Status.InvalidArgument, () => ImageSource.FromPixels(new float[8], 2, 2));
            Assert.Fails(
                Status.InvalidArgument, () => ImageSource.FromPixels(new float[4], -2, -2));
            Assert.Fails(Status.InvalidArgument, () => ImageSource.FromPixels(null, 2, 2));
            Assert.Fails(Status.InvalidArgument, () => Take(string.Empty));
            var error = Fails(
                Status.OutOfRange,
                settings => settings.WrinkleMask = new[] { 1f, 1f, float.NaN, 1f });
            Assert.Contains("(0, 1)", error.Message);
            Fails(Status.Io, settings => settings.WrinkleMask = Ball.NoFile("mask"));
        }

        private static void Files()
        {
            var folder = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName());
            Directory.CreateDirectory(Path.Combine(folder, "deep"));
            try
            {
                var path = Path.Combine(folder, "mask.png");
                var deeper = Path.Combine(folder, "deep", "skin.png");
                using (var engine = new Engine())
                using (var graph = engine.CreateGraph())
                using (var noise = graph.Compute(
                    graph.Add("perlin noise"),
                    new ComputeOptions { Width = 96, Height = 96, Format = PixelFormat.Grey8 }))
                {
                    noise.Save(path);
                    noise.Save(deeper);
                    var settings = Ball.Small(AgingOutputs.Height);
                    // The file has the rounded numbers, the image those before.
                    settings.WrinkleMask = noise.ToArray().Select(grey => grey / 255f).ToArray();
                    var wanted = Heights(settings);
                    settings.WrinkleMask = path;
                    settings.SkinColor = deeper;
                    Assert.Same(wanted, Heights(settings));
                    settings.Outputs = AgingOutputs.View;
                    Ball.With(settings, result => result.View.Width);
                    settings.Outputs = AgingOutputs.Height;
                    settings.WrinkleMask = noise.ToFloatArray();
                    wanted = Heights(settings);
                    settings.WrinkleMask = noise;
                    Assert.Same(wanted, Heights(settings));
                }
            }
            finally
            {
                Directory.Delete(folder, true);
            }
        }

        private static void Fine()
        {
            var settings = Ball.Small(AgingOutputs.Normals);
            var coarse = Normals(settings);
            settings.FineTile = Enumerable.Range(0, 64).Select(i => i % 8 / 8f).ToArray();
            var fine = Normals(settings);
            Assert.True(!coarse.SequenceEqual(fine), "fine wrinkles");
            settings.FineMask = new float[1];
            Assert.Same(coarse, Normals(settings));
            settings.FineMask = null;
            settings.Age = 0;
            Assert.True(Normals(settings).Where((n, i) => i % 4 == 2).All(z => z == 1), "young");
        }

        private static void SkinColor()
        {
            var settings = Ball.Small(AgingOutputs.View);
            settings.SkinColor = ImageSource.FromPixels(new[] { 0f, 0f, 1f }, 1, 1);
            settings.Hairs = 0;
            var pixels = Ball.With(settings, result => result.View.ToArray());
            var middle = ((48 * 96) + 48) * 4;
            Assert.True(pixels[middle + 2] > pixels[middle] + 40, "blue skin");
            Assert.Equal((byte)255, pixels[middle + 3]);
            Assert.Equal((byte)0, pixels[3]);
        }

        private static void Regions()
        {
            var settings = Ball.Small(AgingOutputs.LossAge);
            var ages = LossAges(settings);
            Assert.Equal(0f, ages[(48 * 96) + 48]);
            Assert.Equal(1f, ages[(44 * 96) + 2]);
            var crown = ages[(10 * 96) + 48];
            Assert.True(crown > 0 && crown < 1, "the crown gets bald, " + crown);
            settings.OuterHair = new[] { 1f };
            settings.InnerHair = new[] { 1f };
            Assert.True(LossAges(settings).All(age => age == 1), "all over, for ever");
            settings.OuterHair = new[] { 0f };
            Assert.True(LossAges(settings).All(age => age == 0), "nowhere");
            settings.Outputs = AgingOutputs.Hair;
            Assert.Equal(0, Ball.With(settings, result => result.Hair.Count));
            Assert.Equal(0, Ball.With(settings, result => result.HairsAt(0)));
        }

        /// <summary>Makes a picture of what is given.</summary>
        private static void Take(ImageSource source)
        {
            Assert.True(source == null, "nothing but null is no picture");
        }

        private static float[] Heights(AgingSettings settings)
        {
            return Ball.With(settings, result => result.Height.ToFloatArray());
        }

        private static float[] Normals(AgingSettings settings)
        {
            return Ball.With(settings, result => result.Normals.ToFloatArray());
        }

        private static float[] LossAges(AgingSettings settings)
        {
            return Ball.With(settings, result => result.LossAge.ToFloatArray());
        }

        private static PtLibException Fails(Status status, Action<AgingSettings> spoil)
        {
            var settings = Ball.Small(AgingOutputs.Height);
            spoil(settings);
            using (var engine = Ball.Engine())
            {
                return Assert.Fails(status, () => AgingSim.Run(engine, Ball.Mesh(), settings));
            }
        }
    }
}
