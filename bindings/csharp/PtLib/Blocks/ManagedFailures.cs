using System;
using System.Collections.Generic;
using System.Diagnostics.CodeAnalysis;

namespace PtLib.Blocks
{
    /// <summary>
    /// The exceptions that blocks written in C# threw a short while ago. A computation is told
    /// only the text of an error by the library; here it finds the exception that belongs to it.
    /// </summary>
    internal static class ManagedFailures
    {
        private const int Kept = 32;

        private static readonly LinkedList<KeyValuePair<string, Exception>> Recent =
            new LinkedList<KeyValuePair<string, Exception>>();

        internal static void Add(string text, Exception exception)
        {
            lock (Recent)
            {
                Recent.AddFirst(new KeyValuePair<string, Exception>(text, exception));
                if (Recent.Count > Kept)
                {
                    Recent.RemoveLast();
                }
            }
        }

        /// <summary>The youngest exception whose text is in the message; it is forgotten.</summary>
        [return: MaybeNull]
        internal static Exception Find(Status status, string message)
        {
            if (status != Status.PluginPanic && status != Status.PluginFailed)
            {
                return null;
            }
            lock (Recent)
            {
                for (var node = Recent.First; node != null; node = node.Next)
                {
                    if (message.Contains(node.Value.Key))
                    {
                        Recent.Remove(node);
                        return node.Value.Value;
                    }
                }
            }
            return null;
        }
    }
}
