using System;
using System.Runtime.InteropServices;
#if NET8_0_OR_GREATER
using System.Runtime.CompilerServices;
#else
using PtLib.Native;
#endif

namespace PtLib.Blocks
{
    /// <summary>
    /// The functions in the tables of blocks written in C#. No exception leaves them.
    /// </summary>
    internal static unsafe class BlockCallbacks
    {
#if NET8_0_OR_GREATER
        internal static readonly IntPtr Create =
            (IntPtr)(delegate* unmanaged[Cdecl]<NativeBlock*, IntPtr, IntPtr*, int>)&OnCreate;

        internal static readonly IntPtr Destroy =
            (IntPtr)(delegate* unmanaged[Cdecl]<IntPtr, void>)&OnDestroy;

        internal static readonly IntPtr Prepare =
            (IntPtr)(delegate* unmanaged[Cdecl]<IntPtr, NativeCall*, NativeSetup*, int>)&OnPrepare;

        internal static readonly IntPtr Compute =
            (IntPtr)(delegate* unmanaged[Cdecl]<
                IntPtr, NativeCall*, NativeWire**, NativeWire**, int>)&OnCompute;
#else
        internal static readonly IntPtr Create;
        internal static readonly IntPtr Destroy;
        internal static readonly IntPtr Prepare;
        internal static readonly IntPtr Compute;

        // The delegates live as long as the process, and so do the functions made of them.
        private static readonly CreateFunction CreateDelegate = OnCreate;
        private static readonly DestroyFunction DestroyDelegate = OnDestroy;
        private static readonly PrepareFunction PrepareDelegate = OnPrepare;
        private static readonly ComputeFunction ComputeDelegate = OnCompute;

        static BlockCallbacks()
        {
            Create = Marshal.GetFunctionPointerForDelegate(CreateDelegate);
            Destroy = Marshal.GetFunctionPointerForDelegate(DestroyDelegate);
            Prepare = Marshal.GetFunctionPointerForDelegate(PrepareDelegate);
            Compute = Marshal.GetFunctionPointerForDelegate(ComputeDelegate);
        }

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int CreateFunction(NativeBlock* block, IntPtr host, IntPtr* instance);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate void DestroyFunction(IntPtr instance);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int PrepareFunction(
            IntPtr instance, NativeCall* call, NativeSetup* setup);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int ComputeFunction(
            IntPtr instance, NativeCall* call, NativeWire** inputs, NativeWire** outputs);
#endif

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(CreateFunction))]
#endif
        private static int OnCreate(NativeBlock* block, IntPtr host, IntPtr* instance)
        {
            try
            {
                HostServices.Find(host);
                var definition = (ManagedBlock)Target(block->UserData);
                *instance = GCHandle.ToIntPtr(GCHandle.Alloc(new BlockInstance(definition)));
                return (int)Status.Ok;
            }
            catch (Exception)
            {
                return (int)Status.NoMemory;
            }
        }

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(DestroyFunction))]
#endif
        private static void OnDestroy(IntPtr instance)
        {
            if (instance != IntPtr.Zero)
            {
                GCHandle.FromIntPtr(instance).Free();
            }
        }

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(PrepareFunction))]
#endif
        private static int OnPrepare(IntPtr instance, NativeCall* call, NativeSetup* setup)
        {
            try
            {
                var self = (BlockInstance)Target(instance);
                self.State = self.Block.PrepareState(new BlockSetup(setup));
                return (int)Status.Ok;
            }
            catch (Exception exception)
            {
                return Failed(call, exception);
            }
        }

#if NET8_0_OR_GREATER
        [UnmanagedCallersOnly(CallConvs = new[] { typeof(CallConvCdecl) })]
#else
        [MonoPInvokeCallback(typeof(ComputeFunction))]
#endif
        private static int OnCompute(
            IntPtr instance, NativeCall* call, NativeWire** inputs, NativeWire** outputs)
        {
            try
            {
                var self = (BlockInstance)Target(instance);
                self.Block.ComputeWith(
                    self.State, new BlockCall(call, inputs, self.Block.Inputs.Count, outputs));
                return (int)Status.Ok;
            }
            catch (Exception exception)
            {
                return Failed(call, exception);
            }
        }

        private static object Target(IntPtr handle)
        {
            return GCHandle.FromIntPtr(handle).Target ?? throw new InvalidOperationException();
        }

        private static int Failed(NativeCall* call, Exception exception)
        {
            var isAsked = new BlockCall(call, null, 0, null).IsCancelled;
            if (exception is OperationCanceledException && isAsked)
            {
                return (int)Status.Cancelled;
            }
            var text = exception.GetType().Name + ": " + exception.Message;
            ManagedFailures.Add(text, exception);
            BlockCall.SetError(call, text);
            return (int)Status.PluginFailed;
        }
    }
}
