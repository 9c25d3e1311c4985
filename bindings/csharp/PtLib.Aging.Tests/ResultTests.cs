using System;
using System.Linq;
using PtLib.Tests;

namespace PtLib.Aging.Tests
{
    /// <summary>What comes out of a run.</summary>
    internal static class ResultTests
    {
        internal static void Run(Runner runner)
        {
            runner.Run("result: life cycle", Life);
            runner.Run("result: only what is asked for", Asked);
            runner.Run("result: hairs at every age are a prefix", Prefix);
            runner.Run("result: ages that are none", WrongAges);
            runner.Run("result: age 0 and age 1", Ends);
            runner.Run("result: another seed, other hair", Seeds);
        }

        private static void Life()
        {
            AgingResult result;
            using (var engine = Ball.Engine())
            {
                result = AgingSim.Run(engine, Ball.Mesh(), Ball.Small(AgingOutputs.All));
            }
            // It needs neither the engine nor the graph any more.
            Assert.Equal(96, result.Height.Width);
            Assert.Equal(PixelFormat.GreyFloat, result.Height.Format);
            Assert.Equal(PixelFormat.RgbaFloat, result.Normals.Format);
            Assert.Equal(PixelFormat.GreyFloat, result.LossAge.Format);
            Assert.Equal(PixelFormat.Rgba8, result.View.Format);
            Assert.Equal(96, result.View.Height);
            Assert.True(result.Hair.Count > 0, "hair");
            Assert.Equal(2 * result.Hair.Count, result.Hair.PointCount);
            var hairs = result.HairsAt(0.5);
            result.Dispose();
            result.Dispose();
            Assert.Throws<ObjectDisposedException>(() => result.Height.ToFloatArray());
            Assert.Throws<ObjectDisposedException>(() => result.Normals.ToFloatArray());
            Assert.Throws<ObjectDisposedException>(() => result.LossAge.ToFloatArray());
            Assert.Throws<ObjectDisposedException>(() => result.View.ToArray());
            Assert.Throws<ObjectDisposedException>(() => result.Hair.FirstPointToArray());
            // It is no native call.
            Assert.Equal(hairs, result.HairsAt(0.5));
        }

        private static void Asked()
        {
            foreach (var one in new[]
            {
                AgingOutputs.None, AgingOutputs.Height, AgingOutputs.Normals,
                AgingOutputs.LossAge, AgingOutputs.View, AgingOutputs.Hair,
            })
            {
                var given = Ball.With(Ball.Small(one), Given);
                Assert.Equal(one, given);
            }
            // Pictures that others need do not even have to be there.
            var settings = Ball.Small(AgingOutputs.Height);
            settings.OuterHair = Ball.NoFile("outer");
            settings.SkinColor = Ball.NoFile("skin");
            settings.FineTile = Ball.NoFile("tile");
            Ball.With(settings, result => result.Height.Width);
            settings.Outputs |= AgingOutputs.Normals;
            using (var engine = Ball.Engine())
            {
                Assert.Fails(Status.Io, () => AgingSim.Run(engine, Ball.Mesh(), settings));
            }
            var bald = Ball.Small(AgingOutputs.View);
            Ball.With(bald, result => Assert.Throws<InvalidOperationException>(
                () => result.HairsAt(0.5)));
        }

        private static AgingOutputs Given(AgingResult result)
        {
            return (result.Height != null ? AgingOutputs.Height : 0)
                | (result.Normals != null ? AgingOutputs.Normals : 0)
                | (result.LossAge != null ? AgingOutputs.LossAge : 0)
                | (result.View != null ? AgingOutputs.View : 0)
                | (result.Hair != null ? AgingOutputs.Hair : 0);
        }

        private static void Prefix()
        {
            var settings = Ball.Small(AgingOutputs.Hair);
            settings.Age = 0;
            using (var engine = Ball.Engine())
            using (var young = AgingSim.Run(engine, Ball.Mesh(), settings))
            {
                var all = young.Hair.ToArray<Point3>("position");
                Assert.Equal(young.Hair.Count, young.HairsAt(0));
                var last = int.MaxValue;
                for (var age = 0; age <= 20; age++)
                {
                    settings.Age = age / 20.0;
                    using (var old = AgingSim.Run(engine, Ball.Mesh(), settings))
                    {
                        var count = young.HairsAt(settings.Age);
                        Assert.Equal(old.Hair.Count, count);
                        Assert.Equal(old.HairsAt(settings.Age), count);
                        Assert.True(count <= last, "hair never comes back");
                        last = count;
                        CheckRoots(all, old.Hair);
                    }
                }
                Assert.True(last > 0 && last < young.Hair.Count, "some are left at the end");
            }
        }

        /// <summary>Roots of strands are the first so many of all: lengths depend on the box around
        /// those that are left.</summary>
        private static void CheckRoots(Point3[] all, Strands strands)
        {
            var points = strands.ToArray<Point3>("position");
            for (var i = 0; i < points.Length; i += 2)
            {
                Assert.Equal(all[i], points[i]);
            }
        }

        private static void WrongAges()
        {
            Ball.With(Ball.Small(AgingOutputs.Hair), result =>
            {
                foreach (var age in new[] { -0.1, 1.1, double.NaN })
                {
                    Assert.Throws<ArgumentOutOfRangeException>(() => result.HairsAt(age));
                }
                return 0;
            });
        }

        private static void Ends()
        {
            var settings = Ball.Small(AgingOutputs.All);
            settings.Age = 0;
            Ball.With(settings, result =>
            {
                Assert.True(result.Height.ToFloatArray().All(height => height == 0), "smooth");
                Assert.Equal(result.HairsAt(0), result.Hair.Count);
                return 0;
            });
            settings.Age = 1;
            Ball.With(settings, result =>
            {
                var most = result.Height.ToFloatArray().Max();
                Assert.True(most > 0.9f && most <= 1, "deep wrinkles, " + most);
                Assert.Equal(result.HairsAt(1), result.Hair.Count);
                Assert.True(result.HairsAt(1) > 0, "some are never lost");
                Assert.True(result.HairsAt(1) < result.HairsAt(0), "some are");
                return 0;
            });
        }

        private static void Seeds()
        {
            var settings = Ball.Small(AgingOutputs.Hair);
            var one = Ball.With(settings, result => result.Hair.ToArray<Point3>("position"));
            settings.Seed = 1;
            var other = Ball.With(settings, result => result.Hair.ToArray<Point3>("position"));
            Assert.True(!one.SequenceEqual(other), "other places");
        }
    }
}
