using System;
#if !NET8_0_OR_GREATER
using System.Collections.Concurrent;
using System.Runtime.InteropServices;
#endif

namespace PtLib.Blocks
{
    /// <summary>
    /// The transcendental functions of the engine, which give the same bits on every platform.
    /// Angles are radians. For blocks written in C#: they are there while one runs.
    /// </summary>
    public static unsafe class EngineMath
    {
#if !NET8_0_OR_GREATER
        private static readonly ConcurrentDictionary<int, Delegate> Known =
            new ConcurrentDictionary<int, Delegate>();

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate double Function1(double x);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate double Function2(double x, double y);
#endif

        /// <summary>The sine.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Sin(double x)
        {
            return Call(0, x);
        }

        /// <summary>The cosine.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Cos(double x)
        {
            return Call(1, x);
        }

        /// <summary>The tangent.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Tan(double x)
        {
            return Call(2, x);
        }

        /// <summary>The arc sine.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Asin(double x)
        {
            return Call(3, x);
        }

        /// <summary>The arc cosine.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Acos(double x)
        {
            return Call(4, x);
        }

        /// <summary>The arc tangent.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Atan(double x)
        {
            return Call(5, x);
        }

        /// <summary>The angle of the point (x, y).</summary>
        /// <param name="y">The first number.</param>
        /// <param name="x">The second number.</param>
        /// <returns>The result.</returns>
        public static double Atan2(double y, double x)
        {
            return Call(6, y, x);
        }

        /// <summary>e to the power of a number.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Exp(double x)
        {
            return Call(7, x);
        }

        /// <summary>2 to the power of a number.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Exp2(double x)
        {
            return Call(8, x);
        }

        /// <summary>The natural logarithm.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Log(double x)
        {
            return Call(9, x);
        }

        /// <summary>The logarithm of base 2.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Log2(double x)
        {
            return Call(10, x);
        }

        /// <summary>A number to the power of another.</summary>
        /// <param name="x">The first number.</param>
        /// <param name="y">The second number.</param>
        /// <returns>The result.</returns>
        public static double Pow(double x, double y)
        {
            return Call(11, x, y);
        }

        /// <summary>The hyperbolic tangent.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Tanh(double x)
        {
            return Call(12, x);
        }

        /// <summary>The cube root.</summary>
        /// <param name="x">The number.</param>
        /// <returns>The result.</returns>
        public static double Cbrt(double x)
        {
            return Call(13, x);
        }

        private static double Call(int index, double x)
        {
            var function = HostServices.Function(HostServices.Math, index);
#if NET8_0_OR_GREATER
            return ((delegate* unmanaged[Cdecl]<double, double>)function)(x);
#else
            var found = Known.GetOrAdd(
                index,
                key => Marshal.GetDelegateForFunctionPointer(function, typeof(Function1)));
            return ((Function1)found)(x);
#endif
        }

        private static double Call(int index, double x, double y)
        {
            var function = HostServices.Function(HostServices.Math, index);
#if NET8_0_OR_GREATER
            return ((delegate* unmanaged[Cdecl]<double, double, double>)function)(x, y);
#else
            var found = Known.GetOrAdd(
                index,
                key => Marshal.GetDelegateForFunctionPointer(function, typeof(Function2)));
            return ((Function2)found)(x, y);
#endif
        }
    }
}
