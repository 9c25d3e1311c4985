use super::*;

fn camera() -> Camera {
    Camera {
        eye: [0.0; 3],
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
        scale: 50.0,
        size: [100, 100],
        near: 0.1,
    }
}

/// A white line between two places of the picture.
fn white(a: [f32; 2], b: [f32; 2]) -> Line {
    Line { ends: [a, b], inverse: [1.0; 2], depth: 1.0, color: [1.0; 3], ..Line::default() }
}

/// The alpha of each pixel of a picture of 100 × 100, tile by tile.
fn picture(lines: &[Line], width: f32) -> Vec<[f32; 4]> {
    let grid = Grid::new(100, 100);
    let packed: Vec<_> = lines.iter().map(Line::pack).collect();
    let mut lists = vec![vec![]; grid.count()];
    for (number, line) in packed.iter().enumerate() {
        tiles(line, width, &grid, |tile| lists[tile].push(entry(line, number)));
    }
    let mut all = vec![[0.0; 4]; 10_000];
    for (number, mut list) in lists.into_iter().enumerate() {
        list.sort_unstable();
        let (mut canvas, mut tile) = (Canvas::default(), Tile::default());
        tile.start(grid.tile(number));
        draw(&mut canvas, &tile, (&packed, &list), width, || Ok::<_, ()>(())).unwrap();
        let rect = tile.rect();
        for y in rect.y0..rect.y1 {
            for x in rect.x0..rect.x1 {
                all[y * 100 + x] = canvas.pixels[(y - rect.y0) * SIDE + x - rect.x0];
            }
        }
    }
    all
}

fn sum(picture: &[[f32; 4]]) -> f32 {
    picture.iter().map(|pixel| pixel[3]).sum()
}

#[test]
fn a_level_line_covers_its_width() {
    for (width, column) in [(1.0, [0.0, 0.5, 0.5, 0.0]), (2.0, [0.5, 1.0, 1.0, 0.5])] {
        let image = picture(&[white([20.0, 30.0], [80.0, 30.0])], width);
        let seen: Vec<_> = (28..32).map(|y| image[y * 100 + 50][3]).collect();
        let expected = if width > 1.0 { [0.0, 1.0, 1.0, 0.0] } else { column };
        assert_eq!(seen, expected, "{width}");
    }
    let odd = picture(&[white([20.0, 30.5], [80.0, 30.5])], 2.0);
    let seen: Vec<_> = (29..32).map(|y| odd[y * 100 + 50][3]).collect();
    assert_eq!(seen, [0.5, 1.0, 0.5]);
}

#[test]
fn thin_lines_fade_and_are_as_heavy_in_any_direction() {
    for (x, y) in [(40.0, 0.0), (30.0, 26.5), (28.3, 28.3), (3.0, 39.9), (0.0, 40.0)] {
        let line = white([50.2, 50.7], [50.2 + x, 50.7 + y]);
        let whole = sum(&picture(&[line], 1.0));
        let length = (x * x + y * y).sqrt();
        assert!((whole / length - 1.0).abs() < 0.08, "{x} {y}: {whole} of {length}");
        let faint = sum(&picture(&[line], 0.25));
        assert!((faint - whole / 4.0).abs() < 1e-3 * whole, "{faint} of {whole}");
    }
}

#[test]
fn a_joint_is_not_drawn_twice() {
    for bend in [[60.0, 50.0], [58.0, 57.0], [50.5, 60.0]] {
        let at = [[40.0, 50.3], [50.0, 50.3], bend];
        let (mut first, mut second) = (white(at[0], at[1]), white(at[1], at[2]));
        let apart = picture(&[first, second], 1.0);
        first.join(&mut second);
        let joined = picture(&[first, second], 1.0);
        assert!(sum(&joined) < sum(&apart), "{bend:?}");
        // Each pixel belongs to one of them: as the larger of both where they are alone.
        let [a, b] = [white(at[0], at[1]), white(at[1], at[2])].map(|l| picture(&[l], 1.0));
        for (i, pixel) in joined.iter().enumerate() {
            assert!(pixel[3] <= a[i][3].max(b[i][3]) + 1e-6, "{bend:?} {i}");
        }
        // And nothing is missing but what rounding leaves.
        let union: f32 = a.iter().zip(&b).map(|(a, b)| a[3].max(b[3])).sum();
        assert!(sum(&joined) > union - 0.5, "{bend:?}: {} of {union}", sum(&joined));
    }
}

#[test]
fn near_lines_lie_over_far_ones_in_any_order() {
    let mut far = Line { color: [1.0, 0.0, 0.0], ..white([10.0, 50.5], [90.0, 50.5]) };
    far.depth = 0.5;
    let near = Line { color: [0.0, 1.0, 0.0], ..white([50.5, 10.0], [50.5, 90.0]) };
    for lines in [[far, near], [near, far]] {
        let image = picture(&lines, 1.0);
        for (column, expected) in [(50, [0.0, 1.0, 0.0, 1.0]), (20, [1.0, 0.0, 0.0, 1.0])] {
            let pixel = image[50 * 100 + column];
            assert!(pixel.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{pixel:?}");
        }
    }
}

#[test]
fn lines_are_cut_to_the_picture_and_never_overflow() {
    let e = 1e18;
    let seen = [
        [[-e, 0.0, -1.0], [e, 0.0, -1.0]],
        [[0.0, 0.0, e], [0.0, 0.01, -e]],
        [[0.3, 0.3, -1.0], [0.3, 0.3, -1.0]],
    ];
    for ends in seen {
        let line = Line::new(&camera(), ends, 1.0).unwrap();
        assert!(line.pack().iter().all(|number| number.is_finite()), "{line:?}");
        assert!(line.ends.iter().flatten().all(|x| (-3.0..=103.0).contains(x)), "{line:?}");
        let white = Line { color: [1.0; 3], ..line };
        let image = picture(&[white], 1.0);
        assert!(image.iter().flatten().all(|number| (0.0..=1.0).contains(number)));
    }
    let long = [[-1e9, 0.0, -1.0], [1e9, 0.0, -1.0]];
    let across = Line { color: [1.0; 3], ..Line::new(&camera(), long, 1.0).unwrap() };
    let whole = sum(&picture(&[across], 1.0));
    assert!((whole - 100.0).abs() < 1e-2, "{whole}");
    let hidden = [
        [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0]],
        [[9.0, 0.0, -1.0], [9.0, 1.0, -1.0]],
        [[e, e, e], [e, -e, e]],
        [[-2.0, 0.0, -0.5], [0.0, -2.0, -0.5]],
    ];
    for ends in hidden {
        assert_eq!(Line::new(&camera(), ends, 1.0), None, "{ends:?}");
    }
}

#[test]
fn tiles_of_a_line_are_those_it_has_pixels_in() {
    let grid = Grid::new(640, 640);
    let line = white([10.0, 12.0], [600.0, 500.0]).pack();
    let mut found = vec![];
    tiles(&line, 1.0, &grid, |tile| found.push(tile));
    // A diagonal meets about as many tiles as it crosses edges, not the whole box of 10 × 8.
    assert!((16..=22).contains(&found.len()), "{found:?}");
    let first = found.clone();
    found.sort_unstable();
    found.dedup();
    assert_eq!(first, found, "in order, each once");
}
