using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Text.RegularExpressions;

namespace PtLib.Tests
{
    /// <summary>The declarations of the binding against the header and the library.</summary>
    internal static class AbiTests
    {
        private const BindingFlags Everything =
            BindingFlags.Static | BindingFlags.Public | BindingFlags.NonPublic;

        internal static void Run(Runner runner)
        {
            runner.Run("abi: every exported function is declared, and no other", Functions);
            runner.Run("abi: every declared function is in the library", Entries);
            runner.Run("abi: structs have the sizes of the library", Sizes);
            runner.Run("abi: the version is that of the header", Version);
            runner.Run("abi: packages have the version of the library", Packages);
            runner.Run("abi: enums have the numbers of the header", Enums);
        }

        private static Type Native(string name)
        {
            return typeof(Engine).Assembly.GetType("PtLib.Native." + name, true);
        }

        private static List<MethodInfo> Imports()
        {
            var imports = new List<MethodInfo>();
            foreach (var method in Native("NativeMethods").GetMethods(Everything))
            {
                if ((method.Attributes & MethodAttributes.PinvokeImpl) != 0)
                {
                    imports.Add(method);
                }
            }
            return imports;
        }

        private static void Functions()
        {
            var exported = new SortedSet<string>();
            foreach (var line in File.ReadAllLines(Repository.File("tests/abi/symbols.txt")))
            {
                if (line.StartsWith("ptl_", StringComparison.Ordinal))
                {
                    exported.Add(line.Trim());
                }
            }
            var declared = new SortedSet<string>();
            foreach (var import in Imports())
            {
                declared.Add(import.Name);
            }
            Assert.Equal(string.Join(" ", exported), string.Join(" ", declared));
            Assert.True(declared.Count > 100, "more than a hundred functions");
        }

        private static void Entries()
        {
            Assert.True(PtLibrary.Version.Length > 0, "a version");
            foreach (var import in Imports())
            {
                Marshal.Prelink(import);
            }
        }

        private static void Sizes()
        {
            var size = Native("NativeMethods").GetMethod("ptl_abi_sizeof", Everything);
            var header = File.ReadAllText(Repository.File("include/ptlib/ptlib.h"));
            var pattern = new Regex(@"#define PTL_STRUCT_(\w+) (\d+)");
            var count = 0;
            foreach (Match match in pattern.Matches(header))
            {
                var name = "Native" + Pascal(match.Groups[1].Value);
                var expected = (UIntPtr)size.Invoke(
                    null, new object[] { uint.Parse(match.Groups[2].Value) });
                if (Marshal.SizeOf(Native(name)) != (int)expected)
                {
                    throw new Exception(
                        name + " has " + Marshal.SizeOf(Native(name)) + " bytes, not " + expected);
                }
                count++;
            }
            Assert.True(count >= 16, "all structs");
        }

        private static void Version()
        {
            var header = File.ReadAllText(Repository.File("include/ptlib/ptlib.h"));
            var match = Regex.Match(header, @"#define PTL_ABI_VERSION (\d+)");
            var declared = Native("NativeMethods").GetField("AbiVersion", Everything);
            Assert.Equal(
                uint.Parse(match.Groups[1].Value), (uint)declared.GetRawConstantValue());
        }

        private static void Packages()
        {
            var files = new[]
            {
                "Directory.Build.props", "PtLib.Native/PtLib.Native.nuspec", "Unity/package.json",
            };
            foreach (var file in files)
            {
                var text = File.ReadAllText(Repository.File("bindings/csharp/" + file));
                Assert.Contains(PtLibrary.Version, text);
                foreach (Match match in Regex.Matches(text, @"\[([0-9.]+)\]"))
                {
                    Assert.Equal(PtLibrary.Version, match.Groups[1].Value);
                }
            }
        }

        private static void Enums()
        {
            var header = File.ReadAllText(Repository.File("include/ptlib/ptlib.h"));
            header += File.ReadAllText(Repository.File("include/ptlib/ptlib_values.h"));
            Compare(header, "PTL_E_", typeof(Status));
            Compare(header, "PTL_LOG_", typeof(LogLevel));
            Compare(header, "PTL_KIND_", typeof(ValueKind));
            Compare(header, "PTL_FORMAT_", typeof(PixelFormat));
            Compare(header, "PTL_PRECISION_", typeof(Precision));
        }

        /// <summary>Each constant of that prefix is a number of the enum.</summary>
        private static void Compare(string header, string prefix, Type type)
        {
            var matches = Regex.Matches(header, "#define " + prefix + @"\w+ (\d+)");
            Assert.True(matches.Count > 2, "constants " + prefix);
            foreach (Match match in matches)
            {
                Assert.True(
                    Enum.IsDefined(type, int.Parse(match.Groups[1].Value)),
                    match.Value + " in " + type);
            }
        }

        private static string Pascal(string name)
        {
            var text = string.Empty;
            foreach (var word in name.Split('_'))
            {
                text += word.Substring(0, 1) + word.Substring(1).ToLowerInvariant();
            }
            return text;
        }
    }
}
