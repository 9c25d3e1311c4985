using System;

namespace PtLib.Native
{
    /// <summary>Numbers of C#, which are signed, as those of C, which are not.</summary>
    internal static class Number
    {
        internal static uint Unsigned(int value, string name)
        {
            if (value < 0)
            {
                throw new ArgumentOutOfRangeException(name, value, "It must not be negative.");
            }
            return (uint)value;
        }

        internal static ulong Unsigned(long value, string name)
        {
            if (value < 0)
            {
                throw new ArgumentOutOfRangeException(name, value, "It must not be negative.");
            }
            return (ulong)value;
        }
    }
}
