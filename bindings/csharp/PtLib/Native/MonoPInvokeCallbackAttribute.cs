#if !NET8_0_OR_GREATER
using System;

namespace PtLib.Native
{
    /// <summary>
    /// Marks methods that C calls. Compilers ahead of time (IL2CPP of Unity) find it by its name
    /// and make an entry for the method.
    /// </summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type)
        {
            Type = type;
        }

        public Type Type { get; }
    }
}
#endif
