using System;
using System.Runtime.CompilerServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>A text of any meaning, such as the string of an L-system.</summary>
    public sealed unsafe class Text : Value
    {
        internal Text(IntPtr value)
            : base(value, 0)
        {
        }

        /// <summary>Makes a text.</summary>
        /// <param name="text">The text.</param>
        /// <returns>The value; dispose of it.</returns>
        public static Text FromString(string text)
        {
            Loader.Ensure();
            return Make(text);
        }

        /// <summary>The text.</summary>
        /// <returns>The text.</returns>
        public override string ToString()
        {
            var data = new NativeTextData { StructSize = (uint)sizeof(NativeTextData) };
            IntPtr error;
            using (var value = Use())
            {
                var status = NativeMethods.ptl_value_text(value.Pointer, &data, &error);
                Errors.Check(status, error);
                return Utf8.Read(data.Text, checked((int)data.Size));
            }
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static Text Make(string text)
        {
            var bytes = Utf8.Of(text, nameof(text));
            fixed (byte* memory = bytes)
            {
                var data = new NativeTextData
                {
                    StructSize = (uint)sizeof(NativeTextData),
                    Text = memory,
                    Size = (UIntPtr)(uint)(bytes.Length - 1),
                };
                IntPtr value, error;
                var status = NativeMethods.ptl_value_from_text(
                    &data, 0, IntPtr.Zero, null, &value, &error);
                Errors.Check(status, error);
                return new Text(value);
            }
        }
    }
}
