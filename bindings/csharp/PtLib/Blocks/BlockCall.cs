using System;
#if !NET8_0_OR_GREATER
using System.Runtime.InteropServices;
#endif
using System.Text;

namespace PtLib.Blocks
{
    /// <summary>One call of the engine to a block written in C#: its images, and what it may ask.
    /// There only during the call.</summary>
    public readonly unsafe ref struct BlockCall
    {
        private readonly NativeCall* call;
        private readonly NativeWire** inputs;
        private readonly int inputCount;
        private readonly NativeWire** outputs;

        internal BlockCall(
            NativeCall* call, NativeWire** inputs, int inputCount, NativeWire** outputs)
        {
            this.call = call;
            this.inputs = inputs;
            this.inputCount = inputCount;
            this.outputs = outputs;
        }

        /// <summary>Whether to stop: nobody looks at the result any more.</summary>
        public bool IsCancelled
        {
            get
            {
#if NET8_0_OR_GREATER
                return ((delegate* unmanaged[Cdecl]<NativeCall*, int>)call->IsCancelled)(call) != 0;
#else
                return Function<AskFunction>(call->IsCancelled)(call) != 0;
#endif
            }
        }

        /// <summary>What is to be written, all of it.</summary>
        public BlockImage Output
        {
            get { return new BlockImage((NativeTile*)outputs[0]->Value, true); }
        }

        /// <summary>What is at an input.</summary>
        /// <param name="index">The number of the input, from 0.</param>
        /// <returns>Absent if it is not connected.</returns>
        public BlockImage Input(int index)
        {
            if ((uint)index >= (uint)inputCount)
            {
                throw new ArgumentOutOfRangeException(nameof(index));
            }
            var wire = inputs[index];
            var isImage = wire->Kind == (uint)ValueKind.Image;
            return new BlockImage(isImage ? (NativeTile*)wire->Value : null, false);
        }

        /// <summary>Ends the call if it is cancelled: ask every millisecond of work.</summary>
        /// <exception cref="OperationCanceledException">It is.</exception>
        public void ThrowIfCancelled()
        {
            if (IsCancelled)
            {
                throw new OperationCanceledException();
            }
        }

        /// <summary>Tells what part of the work is done; only of use in an
        /// <see cref="ImageBlock{TState}"/>.</summary>
        /// <param name="fraction">0 to 1.</param>
        public void Report(double fraction)
        {
#if NET8_0_OR_GREATER
            ((delegate* unmanaged[Cdecl]<NativeCall*, double, void>)call->Report)(call, fraction);
#else
            Function<ReportFunction>(call->Report)(call, fraction);
#endif
        }

        /// <summary>Tells the user that something is not as its author meant it, though the block
        /// goes on.</summary>
        /// <param name="message">What.</param>
        public void Warn(string message)
        {
            Tell(call, call->Warn, message);
        }

        internal static void SetError(NativeCall* call, string message)
        {
            Tell(call, call->SetError, message);
        }

        private static void Tell(NativeCall* call, IntPtr function, string message)
        {
            fixed (byte* text = Encoding.UTF8.GetBytes(message.Replace('\0', ' ') + "\0"))
            {
#if NET8_0_OR_GREATER
                ((delegate* unmanaged[Cdecl]<NativeCall*, byte*, void>)function)(call, text);
#else
                Function<TellFunction>(function)(call, text);
#endif
            }
        }

#if !NET8_0_OR_GREATER
        private static T Function<T>(IntPtr pointer)
            where T : class
        {
            return (T)(object)Marshal.GetDelegateForFunctionPointer(pointer, typeof(T));
        }

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int AskFunction(NativeCall* call);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate void ReportFunction(NativeCall* call, double fraction);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate void TellFunction(NativeCall* call, byte* text);
#endif
    }
}
