using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

namespace PtLib.Native
{
    /// <summary>An array of texts for a call.</summary>
    internal sealed unsafe class TextList : IDisposable
    {
        private readonly List<GCHandle> pins = new List<GCHandle>();
        private readonly IntPtr[] pointers;

        internal TextList(ICollection<string> texts, string parameter)
        {
            pointers = new IntPtr[texts.Count];
            try
            {
                foreach (var text in texts)
                {
                    var bytes = GCHandle.Alloc(Utf8.Of(text, parameter), GCHandleType.Pinned);
                    pointers[pins.Count] = bytes.AddrOfPinnedObject();
                    pins.Add(bytes);
                }
                var list = GCHandle.Alloc(pointers, GCHandleType.Pinned);
                pins.Add(list);
                Pointer = (byte**)list.AddrOfPinnedObject();
            }
            catch
            {
                Dispose();
                throw;
            }
        }

        internal byte** Pointer { get; }

        internal uint Count
        {
            get { return (uint)pointers.Length; }
        }

        public void Dispose()
        {
            foreach (var pin in pins)
            {
                pin.Free();
            }
            pins.Clear();
        }
    }
}
