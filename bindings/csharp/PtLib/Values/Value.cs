using System;
using System.Runtime.InteropServices;
using PtLib.Native;

namespace PtLib
{
    /// <summary>
    /// What flows on a wire. It never changes, and any thread may read it. Dispose of it.
    /// </summary>
    public abstract unsafe class Value : IDisposable
    {
        internal const uint Borrow = 1;

        private readonly ValueHandle handle;

        internal Value(IntPtr value, long bytes)
        {
            handle = new ValueHandle(value, bytes);
        }

        /// <summary>What it is.</summary>
        public ValueKind Kind
        {
            get
            {
                using (var value = handle.Use())
                {
                    return (ValueKind)NativeMethods.ptl_value_kind(value.Pointer);
                }
            }
        }

        /// <summary>Gives up the value.</summary>
        public void Dispose()
        {
            handle.Dispose();
        }

        /// <summary>Makes the class of a value's kind; it owns the value from then on.</summary>
        internal static Value Of(IntPtr value)
        {
            switch ((ValueKind)NativeMethods.ptl_value_kind(value))
            {
                case ValueKind.Mesh:
                    return new Mesh(value);
                case ValueKind.Points:
                    return new Points(value);
                case ValueKind.Strands:
                    return new Strands(value);
                case ValueKind.Text:
                    return new Text(value);
                case ValueKind.Gradient:
                    return new Gradient(value);
                default:
                    return new ImageValue(value);
            }
        }

        internal Lease Use()
        {
            return handle.Use();
        }

        /// <summary>Elements of an array as a count of C.</summary>
        internal static uint Length(Array array, string name)
        {
            if (array == null)
            {
                throw new PtLibException(
                    Status.InvalidArgument, name + " is null, an array is needed.", name);
            }
            return (uint)array.Length;
        }

        /// <summary>User data for a loan: Callbacks.Free gets it.</summary>
        internal static void* LendOut(params GCHandle[] pins)
        {
            return (void*)GCHandle.ToIntPtr(GCHandle.Alloc(new Loan(pins)));
        }
    }
}
