//! Golden pictures: the sheets of the table, 64 × 64 a tile.
//!
//! `tests/golden/NAME.png` is for people; `tests/golden/hashes.txt` has the hash of the bits of
//! each tile's `f32` planes, which must never change. `PTLIB_BLESS=1` rewrites both: look at the
//! pictures before you commit them.

use std::{
    fs,
    path::{Path, PathBuf},
};

use ptlib::{
    ComputeOptions, Engine, EngineOptions, Format, Image, Limits,
    io::{BitDepth, read_value, save_image},
    value::{BufferPool, Kind, Value},
};

use crate::sheets::{self, SHEETS, Sheet, Tile};

const SIDE: u32 = 64;

#[test]
fn all_pictures_have_the_golden_bits() {
    let engine = sheets::engine(EngineOptions::default()).unwrap();
    let bless = std::env::var_os("PTLIB_BLESS").is_some();
    let hashes = sheets::path("tests/golden/hashes.txt");
    let golden = fs::read_to_string(&hashes).unwrap_or_default();
    let (mut found, mut faults) = (String::new(), vec![]);
    for sheet in SHEETS {
        let tiles: Vec<_> =
            sheet.tiles.iter().map(|tile| render(&engine, sheet, tile, 1)).collect();
        for (tile, image) in sheet.tiles.iter().zip(&tiles) {
            let line = format!("{:016x} {}, {}\n", hash(image), sheet.name, tile.0);
            if !golden.contains(&line) {
                faults.push(format!("{}, {}: other bits", sheet.name, tile.0));
            }
            found += &line;
        }
        faults.extend(check_picture(sheet, &tiles, bless));
    }
    if bless {
        fs::write(hashes, found).unwrap();
    } else {
        let hint = "if that is meant, PTLIB_BLESS=1 rewrites them; look at them before you commit";
        assert!(faults.is_empty(), "{} faults:\n{}\n{hint}", faults.len(), faults.join("\n"));
        assert_eq!(found, golden, "hashes of pictures that are gone");
    }
}

#[test]
fn the_number_of_threads_does_not_matter() {
    let engine = sheets::engine(EngineOptions { cache_bytes: 0, ..Default::default() }).unwrap();
    for sheet in SHEETS {
        for tile in sheet.tiles {
            let [one, others @ ..] =
                [1, 2, 3, 8].map(|threads| hash(&render(&engine, sheet, tile, threads)));
            assert_eq!(others, [one; 3], "{}, {}", sheet.name, tile.0);
        }
    }
}

fn render(engine: &Engine, sheet: &Sheet, tile: &Tile, threads: u32) -> Image {
    let options = ComputeOptions { size: Some((SIDE, SIDE)), threads, ..Default::default() };
    sheet.scene.render(engine, tile.1, options).unwrap()
}

/// The hash of an image's bits: FNV-1a, 64 bits.
fn hash(image: &Image) -> u64 {
    let numbers = (0..image.planes()).flat_map(|channel| image.channel(channel));
    numbers
        .flat_map(|number| number.to_bits().to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
}

/// Compares (or rewrites) the picture for people. Returns what is wrong.
fn check_picture(sheet: &Sheet, tiles: &[Image], bless: bool) -> Option<String> {
    let tiles: Vec<_> = tiles.iter().map(|tile| sheet.scene.flat(tile).unwrap()).collect();
    let sheet_of_tiles = sheets::join(&tiles, sheet.columns).unwrap();
    let path = sheets::path("tests/golden").join(sheet.name).with_extension("png");
    if bless {
        fs::create_dir_all(sheets::path("tests/golden")).unwrap();
        save_image(&sheet_of_tiles, &path, BitDepth::Eight).unwrap();
        return None;
    }
    if !path.exists() {
        return Some(format!("{}: no golden picture", sheet.name));
    }
    let golden = read(&path);
    let [found, expected] = [&sheet_of_tiles, &golden].map(|image| image.to_pixels(Format::Rgb8));
    if found.data == expected.data {
        return None;
    }
    let written = write(&format!("{}-found", sheet.name), &sheet_of_tiles);
    if (found.width, found.height) == (expected.width, expected.height) {
        write(&format!("{}-difference", sheet.name), &difference(&sheet_of_tiles, &golden));
    }
    Some(format!("{}: another picture, see {}", sheet.name, written.display()))
}

fn read(path: &Path) -> Image {
    match read_value(path, Kind::Image, &Limits::default()).unwrap() {
        Value::Image(image) => image,
        other => panic!("a {}", other.kind().name()),
    }
}

/// Writes a PNG below the target folder and returns its path.
fn write(name: &str, image: &Image) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("aging-pictures");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name).with_extension("png");
    save_image(image, &path, BitDepth::Eight).unwrap();
    path
}

/// Where two pictures differ, eight times amplified.
fn difference(found: &Image, golden: &Image) -> Image {
    let mut steps = Image::new(&BufferPool::new(), found.width(), found.height(), 3).unwrap();
    for (channel, plane) in steps.planes_mut().enumerate() {
        let pairs = found.channel(channel).iter().zip(golden.channel(channel));
        for (step, (a, b)) in plane.iter_mut().zip(pairs) {
            *step = (8.0 * (a - b).abs()).min(1.0);
        }
    }
    steps
}
