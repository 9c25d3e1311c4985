using System;
using System.IO;

namespace PtLib.Tests
{
    /// <summary>Files of the repository that tests compare with.</summary>
    internal static class Repository
    {
        /// <summary>A file, by its path from the root: what the variable PTLIB_REPOSITORY says, or
        /// the folder above this program that has include/ptlib.</summary>
        internal static string File(string path)
        {
            var root = Environment.GetEnvironmentVariable("PTLIB_REPOSITORY");
            if (string.IsNullOrEmpty(root))
            {
                var folder = new DirectoryInfo(AppContext.BaseDirectory);
                while (folder != null &&
                    !Directory.Exists(Path.Combine(folder.FullName, "include", "ptlib")))
                {
                    folder = folder.Parent;
                }
                root = folder == null ? "." : folder.FullName;
            }
            return Path.Combine(root, path);
        }
    }
}
