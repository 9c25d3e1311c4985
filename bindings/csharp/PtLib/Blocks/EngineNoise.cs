using System;
#if !NET8_0_OR_GREATER
using System.Runtime.InteropServices;
#endif

namespace PtLib.Blocks
{
    /// <summary>
    /// The random numbers of the engine, which depend on their arguments only. For blocks written
    /// in C#: they are there while one runs.
    /// </summary>
    public static unsafe class EngineNoise
    {
        private const float Unit = 1.0f / (1 << 24);

#if !NET8_0_OR_GREATER
        private static readonly Lazy<HashFunction> Function = new Lazy<HashFunction>(
            () => (HashFunction)Marshal.GetDelegateForFunctionPointer(
                HostServices.Function(HostServices.Noise, 0), typeof(HashFunction)),
            System.Threading.LazyThreadSafetyMode.PublicationOnly);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate uint HashFunction(ulong seed, uint item, uint part, uint channel);
#endif

        /// <summary>32 random bits of a seed and three numbers.</summary>
        /// <param name="seed">The seed.</param>
        /// <param name="item">Such as the number of an item.</param>
        /// <param name="part">Such as a part of it.</param>
        /// <param name="channel">Such as a channel.</param>
        /// <returns>The bits.</returns>
        public static uint Hash(ulong seed, uint item, uint part, uint channel)
        {
#if NET8_0_OR_GREATER
            var function = HostServices.Function(HostServices.Noise, 0);
            return ((delegate* unmanaged[Cdecl]<ulong, uint, uint, uint, uint>)function)(
                seed, item, part, channel);
#else
            return Function.Value(seed, item, part, channel);
#endif
        }

        /// <summary>A number of 0 to before 1: the upper 24 bits of <see cref="Hash"/>.</summary>
        /// <param name="seed">The seed.</param>
        /// <param name="item">Such as the number of an item.</param>
        /// <param name="part">Such as a part of it.</param>
        /// <param name="channel">Such as a channel.</param>
        /// <returns>The number.</returns>
        public static float Uniform(ulong seed, uint item, uint part, uint channel)
        {
            return (Hash(seed, item, part, channel) >> 8) * Unit;
        }
    }
}
