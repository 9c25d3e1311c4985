using System;
using System.Diagnostics;
using System.IO;
using System.Runtime.InteropServices;

namespace PtLib.Tests
{
    /// <summary>Finding the native library: each test in a process of its own.</summary>
    internal static class LoadingTests
    {
        /// <summary>A variable that tells the other process what to do before it loads.</summary>
        private const string Way = "PTLIB_TEST_LOADING";

        internal static void Run(Runner runner)
        {
            runner.Run("loading: a file that is not there", MissingFile);
            runner.Run("loading: a folder without the library", MissingInFolder);
            runner.Run("loading: a file that is no library", NoLibrary);
            runner.Run("loading: a library of another ABI version", WrongVersion);
            runner.Run("loading: the file is told", LoadedFrom);
            runner.Run("loading: every path is listed", Listed);
            runner.Run("loading: a program that finds the library by itself", Switch);
#if NET8_0_OR_GREATER
            runner.Run("loading: a resolver that is there already", OwnResolver);
#endif
            runner.Run("loading: beside the assembly, and below runtimes", Installed);
        }

        /// <summary>In the other process.</summary>
        internal static int LoadHere()
        {
            var way = Environment.GetEnvironmentVariable(Way);
            try
            {
                if (way == "switch")
                {
                    AppContext.SetSwitch("PtLib.DisableNativeResolver", true);
                }
#if NET8_0_OR_GREATER
                if (way == "own")
                {
                    NativeLibrary.SetDllImportResolver(
                        typeof(Engine).Assembly,
                        (name, assembly, search) => throw new DllNotFoundException("own resolver"));
                }
#endif
                using (new Engine())
                {
                    Console.WriteLine("loaded " + PtLibrary.LoadedFrom);
                }
                return 0;
            }
            catch (PtLibLoadException exception)
            {
                Console.WriteLine(exception.PathsTried.Count + " tried: " + exception.Message);
                return 3;
            }
        }

        private static void MissingFile()
        {
            var text = Load("/no/such/libptlib.so", 3);
            Assert.Contains("1 tried", text);
            Assert.Contains("/no/such/libptlib.so", text);
            Assert.Contains("PTLIB_NATIVE_PATH", text);
        }

        private static void MissingInFolder()
        {
            var folder = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName());
            Directory.CreateDirectory(folder);
            try
            {
                Assert.Contains(folder, Load(folder, 3));
            }
            finally
            {
                Directory.Delete(folder, true);
            }
        }

        private static void NoLibrary()
        {
            var file = Path.GetTempFileName();
            try
            {
                Assert.Contains("could not be loaded", Load(file, 3));
            }
            finally
            {
                File.Delete(file);
            }
        }

        private static void WrongVersion()
        {
            var library = Environment.GetEnvironmentVariable("PTLIB_TEST_OTHER_ABI");
            if (string.IsNullOrEmpty(library))
            {
                Console.WriteLine("(no library of another ABI: set PTLIB_TEST_OTHER_ABI)");
                return;
            }
            var text = Load(library, 3);
            Assert.Contains("ABI version 999", text);
            Assert.Contains("made for version 0", text);
            Assert.Contains(library, text);
        }

        private static void LoadedFrom()
        {
            var file = PtLibrary.LoadedFrom;
            if (file.Length > 0)
            {
                Assert.Contains("loaded " + file, Load(file, 0));
            }
        }

        private static void Listed()
        {
            string text;
            try
            {
                text = Load(string.Empty, 3);
            }
            catch (Exception exception) when (exception.Message.Contains("loaded"))
            {
                return; // it is installed in the system
            }
            Assert.Contains("runtimes", text);
            Assert.Contains("where the system looks", text);
            Assert.Contains(AppContext.BaseDirectory.TrimEnd('/', '\\'), text);
        }

        private static void Switch()
        {
            string text;
            try
            {
                text = Load("/no/such/file", 3, null, "switch");
            }
            catch (Exception exception) when (exception.Message.Contains("loaded"))
            {
                return; // it is installed in the system
            }
            Assert.True(!text.Contains("/no/such/file"), "the variable does not count: " + text);
            Assert.Contains("where the system looks", text);
        }

#if NET8_0_OR_GREATER
        private static void OwnResolver()
        {
            var text = Load(Environment.GetEnvironmentVariable("PTLIB_NATIVE_PATH"), 3, null, "own");
            Assert.Contains("own resolver", text);
        }
#endif

        /// <summary>A copy of the program, with the library where packages put it.</summary>
        private static void Installed()
        {
            var library = PtLibrary.LoadedFrom;
            if (library.Length == 0)
            {
                return;
            }
            var folder = Path.Combine(Path.GetTempPath(), Path.GetRandomFileName());
            Directory.CreateDirectory(folder);
            try
            {
                foreach (var file in Directory.GetFiles(AppContext.BaseDirectory, "PtLib*"))
                {
                    File.Copy(file, Path.Combine(folder, Path.GetFileName(file)));
                }
                var program = Path.Combine(
                    folder, Path.GetFileName(typeof(LoadingTests).Assembly.Location));
                var native = Path.Combine(folder, "runtimes", RuntimeId(), "native");
                Directory.CreateDirectory(native);
                var name = Path.GetFileName(library);
                File.Copy(library, Path.Combine(native, name));
                Assert.Contains("loaded " + native, Load(string.Empty, 0, program));
                File.Move(Path.Combine(native, name), Path.Combine(folder, name));
                Assert.Contains(
                    "loaded " + Path.Combine(folder, name), Load(string.Empty, 0, program));
            }
            finally
            {
                Directory.Delete(folder, true);
            }
        }

        private static string RuntimeId()
        {
            var system = Path.DirectorySeparatorChar == '\\' ? "win"
                : RuntimeInformation.IsOSPlatform(OSPlatform.OSX) ? "osx" : "linux";
            return system + "-" +
                RuntimeInformation.ProcessArchitecture.ToString().ToLowerInvariant();
        }

        /// <summary>Loads the library in a process with PTLIB_NATIVE_PATH.</summary>
        private static string Load(
            string path, int code, string program = null, string way = "")
        {
            var host = Process.GetCurrentProcess().MainModule.FileName;
            program = program ?? typeof(LoadingTests).Assembly.Location;
            var start = new ProcessStartInfo(host, "\"" + program + "\" --load")
            {
                UseShellExecute = false,
                RedirectStandardOutput = true,
            };
            start.EnvironmentVariables["PTLIB_NATIVE_PATH"] = path ?? string.Empty;
            start.EnvironmentVariables[Way] = way;
            using (var process = Process.Start(start))
            {
                var text = process.StandardOutput.ReadToEnd();
                process.WaitForExit();
                if (process.ExitCode != code)
                {
                    throw new Exception("exit code " + process.ExitCode + ": " + text);
                }
                return text;
            }
        }
    }
}
