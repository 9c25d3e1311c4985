using System;
using System.Diagnostics.CodeAnalysis;
using System.Text;

namespace PtLib.Native
{
    /// <summary>Texts of the library: UTF-8 with a NUL behind.</summary>
    internal static unsafe class Utf8
    {
        private static readonly UTF8Encoding Strict = new UTF8Encoding(false, true);

        /// <summary>The bytes of a text, and a NUL.</summary>
        internal static byte[] Of(string text, string parameter)
        {
            if (text == null)
            {
                throw new ArgumentNullException(parameter);
            }
            if (text.IndexOf('\0') >= 0)
            {
                throw new ArgumentException("A text must not contain a NUL character.", parameter);
            }
            var bytes = new byte[Strict.GetByteCount(text) + 1];
            Strict.GetBytes(text, 0, text.Length, bytes, 0);
            return bytes;
        }

        /// <summary>The same, of a text that may be missing: then null, which is NULL in C.</summary>
        [return: MaybeNull]
        internal static byte[] OfOptional([AllowNull] string text, string parameter)
        {
            return text == null ? default(byte[]) : Of(text, parameter);
        }

        /// <summary>The text that C points to; empty for NULL.</summary>
        internal static string Read(byte* text)
        {
            if (text == null)
            {
                return string.Empty;
            }
            var length = 0;
            while (text[length] != 0)
            {
                length++;
            }
            return Read(text, length);
        }

        /// <summary>A text of so many bytes.</summary>
        internal static string Read(byte* text, int length)
        {
            return length == 0 ? string.Empty : Encoding.UTF8.GetString(text, length);
        }

        /// <summary>The text that bytes of the library hold; they are released.</summary>
        internal static string Take(IntPtr bytes)
        {
            try
            {
                UIntPtr size;
                var data = (byte*)NativeMethods.ptl_bytes_data(bytes, &size);
                return Read(data, checked((int)size));
            }
            finally
            {
                NativeMethods.ptl_bytes_release(bytes);
            }
        }

        /// <summary>Writes a text and a NUL into memory that is never freed.</summary>
        internal static byte* Keep(string text, string parameter)
        {
            var bytes = Of(text, parameter);
            var memory = System.Runtime.InteropServices.Marshal.AllocHGlobal(bytes.Length);
            System.Runtime.InteropServices.Marshal.Copy(bytes, 0, memory, bytes.Length);
            return (byte*)memory;
        }
    }
}
