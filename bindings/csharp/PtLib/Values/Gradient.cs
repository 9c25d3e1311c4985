using System;
using System.Runtime.CompilerServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>A colour transition: constant before the first stop and after the last, linear
    /// between.</summary>
    public sealed unsafe class Gradient : Value
    {
        internal Gradient(IntPtr value)
            : base(value, 0)
        {
        }

        /// <summary>Makes a colour transition.</summary>
        /// <param name="stops">The colours, in any order; of those at one position the first
        /// counts. Without any it is a middle grey.</param>
        /// <returns>The transition; dispose of it.</returns>
        /// <exception cref="PtLibException">The array is null, or a number is outside of 0 to 1:
        /// the message names the first one.</exception>
        public static Gradient FromStops(params GradientStop[] stops)
        {
            Loader.Ensure();
            return Make(stops);
        }

        /// <summary>The colours, by rising position.</summary>
        /// <returns>A new array.</returns>
        public GradientStop[] ToArray()
        {
            var data = new NativeGradientData { StructSize = (uint)sizeof(NativeGradientData) };
            IntPtr error;
            using (var value = Use())
            {
                var status = NativeMethods.ptl_value_gradient(value.Pointer, &data, &error);
                Errors.Check(status, error);
                var stops = new GradientStop[data.StopCount];
                for (var i = 0; i < stops.Length; i++)
                {
                    stops[i] = data.Stops[i];
                }
                return stops;
            }
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static Gradient Make(GradientStop[] stops)
        {
            var count = Length(stops, nameof(stops));
            fixed (GradientStop* memory = stops)
            {
                var data = new NativeGradientData
                {
                    StructSize = (uint)sizeof(NativeGradientData),
                    StopCount = count,
                    Stops = memory,
                };
                IntPtr value, error;
                var status = NativeMethods.ptl_value_from_gradient(
                    &data, 0, IntPtr.Zero, null, &value, &error);
                Errors.Check(status, error);
                return new Gradient(value);
            }
        }
    }
}
