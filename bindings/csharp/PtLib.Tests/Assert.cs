using System;
using System.Collections.Generic;

namespace PtLib.Tests
{
    /// <summary>What a test expects.</summary>
    internal static class Assert
    {
        internal static void True(bool condition, string what)
        {
            if (!condition)
            {
                throw new Exception("expected: " + what);
            }
        }

        internal static void Equal<T>(T expected, T actual)
        {
            if (!EqualityComparer<T>.Default.Equals(expected, actual))
            {
                throw new Exception("expected " + expected + ", got " + actual);
            }
        }

        internal static void Same<T>(T[] expected, T[] actual)
        {
            Equal(expected.Length, actual.Length);
            for (var i = 0; i < expected.Length; i++)
            {
                if (!EqualityComparer<T>.Default.Equals(expected[i], actual[i]))
                {
                    throw new Exception(
                        "at " + i + ": expected " + expected[i] + ", got " + actual[i]);
                }
            }
        }

        internal static void Contains(string part, string text)
        {
            True(text.Contains(part), "\"" + part + "\" in \"" + text + "\"");
        }

        /// <summary>The exception that the action throws, of exactly this type.</summary>
        internal static T Throws<T>(Action action)
            where T : Exception
        {
            try
            {
                action();
            }
            catch (Exception exception)
            {
                if (exception.GetType() == typeof(T))
                {
                    return (T)exception;
                }
                throw new Exception("expected " + typeof(T) + ", got " + exception, exception);
            }
            throw new Exception("expected " + typeof(T) + ", nothing was thrown");
        }

        /// <summary>The PtLibException that the action throws, with this status.</summary>
        internal static PtLibException Fails(Status status, Action action)
        {
            var exception = Throws<PtLibException>(action);
            if (exception.Status != status)
            {
                throw new Exception(
                    "expected status " + status + ", got " + exception.Status + ": " +
                    exception.Message);
            }
            return exception;
        }
    }
}
