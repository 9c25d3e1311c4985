using PtLib.Native;

namespace PtLib
{
    /// <summary>An input or an output of a block type.</summary>
    public sealed class Port
    {
        internal unsafe Port(NativePortInfo info)
        {
            Id = Utf8.Read(info.Id);
            Name = Utf8.Read(info.Name);
            Kind = (ValueKind)info.Kind;
            IsOptional = (info.Flags & 1) != 0;
            HasFreeRange = (info.Flags & 2) != 0;
            Channels = (int)info.Channels;
        }

        /// <summary>Its id.</summary>
        public string Id { get; }

        /// <summary>Its name for a user interface.</summary>
        public string Name { get; }

        /// <summary>What flows through it.</summary>
        public ValueKind Kind { get; }

        /// <summary>Whether the block works without this input.</summary>
        public bool IsOptional { get; }

        /// <summary>Whether this output gives any finite numbers (heights, distances), not only 0
        /// to 1.</summary>
        public bool HasFreeRange { get; }

        /// <summary>Channels of an output image: 1 or 3; 0 if that depends on inputs or
        /// parameters.</summary>
        public int Channels { get; }
    }
}
