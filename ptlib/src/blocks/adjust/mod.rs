//! Blocks that change values pixel by pixel.

crate::family!(
    "adjust": adjust_hsl, adjust_rgb, brightness_and_contrast, crop_amplitude, dither, grayscale,
    invert, replace_colors, sine_transform,
);

mod dithering;
