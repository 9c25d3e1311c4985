namespace PtLib
{
    /// <summary>How pixels are laid out: interleaved channels, rows from the top.</summary>
    public enum PixelFormat
    {
        /// <summary>
        /// As many channels as the output has; 8 bits each if values are computed in 8
        /// bits, 32-bit floating-point numbers otherwise. It loses nothing.
        /// </summary>
        Auto = 0,

        /// <summary>One byte a pixel.</summary>
        Grey8 = 257,

        /// <summary>Red, green, blue: a byte each.</summary>
        Rgb8 = 259,

        /// <summary>Red, green, blue, alpha: a byte each.</summary>
        Rgba8 = 260,

        /// <summary>One 16-bit number in the machine's byte order.</summary>
        Grey16 = 513,

        /// <summary>Three 16-bit numbers.</summary>
        Rgb16 = 515,

        /// <summary>Four 16-bit numbers.</summary>
        Rgba16 = 516,

        /// <summary>One float.</summary>
        GreyFloat = 66561,

        /// <summary>Three floats.</summary>
        RgbFloat = 66563,

        /// <summary>Four floats.</summary>
        RgbaFloat = 66564,
    }
}
