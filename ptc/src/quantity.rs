//! Quantities on the command line: sizes of pictures and amounts of memory.

use std::str::FromStr;

/// The size of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Size {
    /// Width and height.
    Exact(u32, u32),
    /// The longer side; the other one keeps the graph's aspect ratio.
    Longer(u32),
}

impl Size {
    /// The size for a graph whose own size is `width` × `height`.
    pub(crate) fn of(self, width: u32, height: u32) -> (u32, u32) {
        match self {
            Self::Exact(width, height) => (width, height),
            Self::Longer(side) if width >= height => (side, scaled(height, side, width)),
            Self::Longer(side) => (scaled(width, side, height), side),
        }
    }
}

/// `shorter` · `side` / `longer`, rounded, at least 1.
fn scaled(shorter: u32, side: u32, longer: u32) -> u32 {
    let longer = u64::from(longer.max(1));
    let length = (u64::from(shorter) * u64::from(side) + longer / 2) / longer;
    u32::try_from(length).unwrap_or(side).max(1)
}

impl FromStr for Size {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, &'static str> {
        let side = |text: &str| match text.parse() {
            Ok(side) if side > 0 => Ok(side),
            _ => Err("a size is WIDTHxHEIGHT or the longer side, in pixels, from 1 on"),
        };
        match text.split_once(['x', 'X', '×']) {
            Some((width, height)) => Ok(Self::Exact(side(width)?, side(height)?)),
            None => side(text).map(Self::Longer),
        }
    }
}

/// An amount of memory in bytes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Bytes(pub(crate) u64);

impl FromStr for Bytes {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, &'static str> {
        const WRONG: &str = "an amount is a whole number of bytes, or of K, M, G or T: 512M, 8G";
        let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
        let (number, unit) = text.split_at(end);
        let unit: u64 = match unit.trim_end_matches(['B', 'b']).trim_end_matches('i') {
            "" => 1,
            "K" | "k" => 1 << 10,
            "M" | "m" => 1 << 20,
            "G" | "g" => 1 << 30,
            "T" | "t" => 1 << 40,
            _ => return Err(WRONG),
        };
        let bytes = number.parse::<u64>().ok().and_then(|number| number.checked_mul(unit));
        bytes.filter(|bytes| *bytes > 0).map(Self).ok_or(WRONG)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read() {
        assert_eq!("640x480".parse(), Ok(Size::Exact(640, 480)));
        assert_eq!("640×480".parse(), Ok(Size::Exact(640, 480)));
        assert_eq!("512".parse(), Ok(Size::Longer(512)));
        for wrong in ["", "0", "0x5", "5x", "x5", "-5", "5x5x5", "1e3", "5.5", "4294967296"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_longer_side_keeps_the_aspect_ratio() {
        assert_eq!(Size::Longer(512).of(256, 256), (512, 512));
        assert_eq!(Size::Longer(512).of(256, 128), (512, 256));
        assert_eq!(Size::Longer(512).of(100, 300), (171, 512));
        assert_eq!(Size::Longer(2).of(1000, 1), (2, 1));
        assert_eq!(Size::Longer(u32::MAX).of(u32::MAX, u32::MAX), (u32::MAX, u32::MAX));
        assert_eq!(Size::Exact(3, 4).of(100, 300), (3, 4));
    }

    #[test]
    fn amounts_are_read() {
        assert_eq!("1000".parse(), Ok(Bytes(1000)));
        assert_eq!("512M".parse(), Ok(Bytes(512 << 20)));
        for eight in ["8G", "8g", "8GB", "8GiB", "8192M"] {
            assert_eq!(eight.parse(), Ok(Bytes(8 << 30)), "{eight}");
        }
        for wrong in ["", "G", "0", "-1", "1.5G", "8 G", "8X", "99999999T"] {
            assert!(wrong.parse::<Bytes>().is_err(), "{wrong}");
        }
    }
}
