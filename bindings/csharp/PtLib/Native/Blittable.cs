using System;
#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
#else
using System.Reflection;
using System.Runtime.InteropServices;
#endif

namespace PtLib.Native
{
    /// <summary>What a struct without references looks like in memory.</summary>
    internal static class Blittable<T>
        where T : struct
    {
#if NET8_0_OR_GREATER
        internal static readonly bool IsBitsOnly =
            !RuntimeHelpers.IsReferenceOrContainsReferences<T>();

        internal static readonly int Size = Unsafe.SizeOf<T>();
#else
        internal static readonly bool IsBitsOnly = IsOnly(typeof(T));

        internal static readonly int Size = IsBitsOnly ? Marshal.SizeOf(typeof(T)) : 0;

        // mono pins whatever it is given, so this looks itself.
        private static bool IsOnly(Type type)
        {
            if (type.IsPrimitive)
            {
                return type != typeof(bool) && type != typeof(char);
            }
            if (type.IsEnum || type.IsPointer)
            {
                return true;
            }
            if (!type.IsValueType)
            {
                return false;
            }
            const BindingFlags fields =
                BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic;
            foreach (var field in type.GetFields(fields))
            {
                if (!IsOnly(field.FieldType))
                {
                    return false;
                }
            }
            return true;
        }
#endif
    }
}
