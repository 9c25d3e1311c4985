//! Draws wrinkles as a height map, from a file that says where the muscles below the skin are.
//!
//! A muscle that contracts folds the skin across its fibre. `grammar` reads the file, `fibre` has
//! the formula of one muscle, `field` adds them up, and `kernels` does so for rows of pixels.
//! Heights of muscles add; the sum is divided by the greatest one and raised to a power, which lifts
//! low wrinkles and flattens crests.
//!
//! The greatest sum is that of a fixed set of places, and a pixel's height depends on its place
//! only: the map is the same at every resolution. Muscles repeat with period 1, so it tiles.

use ptlib_plugin::prelude::*;

use super::{
    arith::{at_most_one, power},
    field::{Columns, Field, Pace},
    grammar::{Faults, Limits, parse},
    kernels::Style,
};

const TEXT: usize = 0;

choice! {
    /// How heights lie across a wrinkle.
    Profile {
        /// Sharp furrows between round swellings, as skin has them.
        Bulge = "bulge",
        /// A sine wave: furrows as round as crests.
        Wave = "wave",
    }
}

choice! {
    /// What becomes 1.
    Normalise {
        /// The greatest sum of heights, so that the map uses the whole range.
        Maximum = "maximum",
        /// A sum of 1, and all above it: muscles far from each other do not change each other.
        None = "none",
    }
}

choice! {
    /// Where the second texture coordinate of muscles points.
    Axis {
        /// Up: 0 is the lower edge.
        Up = "up",
        /// Down: 0 is the upper edge.
        Down = "down",
    }
}

params! {
    /// Parameters of `wrinkle map`.
    Params {
        /// The muscles, as text: each `!` starts one, `ma=0.3;0.75` and `mb=0.33;0.6` say where its
        /// fibre starts and ends in texture coordinates, and `n=4` how many wrinkles lie across it.
        /// Those three must be there. `relWidth` (up to 1, else 0.5) is half of its width in
        /// lengths of the fibre, `maxAngle` (1 to 2, else 1.25) how far wrinkles go round its end in
        /// right angles, `omegaLow` (0 to 1, else 0.5) the part of its wrinkles that is left at its
        /// rim, and `amplitude` (0 to 4, else 1) how high it is. `#` starts a comment. The
        /// input, if it is connected, and the file of `path` replace it.
        muscles: text = "! ma=.3;.75 mb=.33;.6 n=4 relWidth=.9 maxAngle=1.5 omegaLow=.6 \
            ! ma=.7;.75 mb=.67;.6 n=4 relWidth=.9 maxAngle=1.5 omegaLow=.6";
        /// A file with the muscles, written as in `muscles`; empty for none. The input, if it is
        /// connected, replaces it.
        path: path [read] = "";
        /// How heights lie across a wrinkle.
        profile: choice [Profile] = Profile::Bulge;
        /// The power to which heights are raised. At 1 they stay what they are; below, low wrinkles
        /// are lifted and crests flattened. Below 0.5, wrinkles end with a visible edge, because
        /// their slope at the rim is no longer 0.
        gamma: float [hard 0.05..=4.0 soft 0.2..=1.0] = 0.4;
        /// What becomes 1.
        normalise: choice [Normalise] = Normalise::Maximum;
        /// Whether heights fade without kinks along the fibre and at the rim. Off, they fall as
        /// straight lines.
        smooth: bool = true;
        /// Where the second texture coordinate of muscles points.
        v_axis "v axis": choice [Axis] = Axis::Up;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct WrinkleMap {
    field: Field,
    columns: Columns,
    /// What becomes 1.
    top: f32,
    gamma: f32,
    v_axis: Axis,
}

impl Block for WrinkleMap {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.wrinkle map",
        name: c"Wrinkle map",
        category: c"wrinkles",
        summary: c"Draws wrinkles as a height map, from a text that describes muscles.",
        inputs: &[&input(c"text", Kind::Text)
            .optional()
            .doc(c"The muscles, as in the parameter of that name, which this replaces.")],
        outputs: &[&output(c"image", Planes::Grey)
            .doc(c"The heights: 0 is flat skin, 1 the highest crest.")],
        shape: Shape::Point,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, setup: &Setup<'_>) -> Result<Self, BlockError> {
        let limits = Limits::default();
        let read = |text: &[u8], source: &str| {
            parse(text, &limits).map_err(|faults| refusal(&faults, source))
        };
        let muscles = match setup.text(TEXT) {
            Some(text) => read(text.as_bytes(), "input \"text\"")?,
            None if params.path.is_empty() => read(params.muscles.as_bytes(), "\"muscles\"")?,
            None => read(&setup.read_file(&params.path)?, &format!("{:?}", params.path))?,
        };
        let proportion = f64::from(setup.width()) / f64::from(setup.height());
        let style = Style { is_wave: params.profile == Profile::Wave, is_smooth: params.smooth };
        let field = Field::new(&muscles, proportion, style);
        let check = || setup.check();
        let top = match params.normalise {
            Normalise::Maximum => field.greatest(&mut Pace::new(&check))?,
            Normalise::None => 1.0,
        };
        let columns = Columns::new(setup.width(), proportion);
        Ok(Self { field, columns, top, gamma: math::single(params.gamma), v_axis: params.v_axis })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let (mut out, work) = call.output_and_work(0)?;
        let check = || work.check();
        let mut pace = Pace::new(&check);
        let (first, height) = (out.y(), f64::from(out.image_height()));
        let (x, width) = (out.x() as usize, out.width() as usize);
        for y in 0..out.height() {
            let down = (f64::from(first) + f64::from(y) + 0.5) / height;
            let v = if self.v_axis == Axis::Up { 1.0 - down } else { down };
            let sums = out.row_mut(0, y);
            sums.fill(0.0);
            self.field.add(&self.columns.row(v, x, width), sums, &mut pace)?;
            finish(sums, self.top, self.gamma);
        }
        Ok(())
    }

    fn memory(_: &Params, width: u32, _: u32) -> u64 {
        Field::memory(Limits::default().muscles) + 8 * u64::from(width)
    }
}

/// The error that tells all faults of a text.
fn refusal(faults: &Faults, source: &str) -> BlockError {
    let message = format!("{source}: {faults}");
    if faults.is_limit() { BlockError::limit(message) } else { BlockError::parse(message) }
}

/// Pixels that are looked at together: whether they are flat.
const CHUNK: usize = 32;

/// Makes heights 0..1 of sums.
fn finish(sums: &mut [f32], top: f32, gamma: f32) {
    if top <= 0.0 {
        return sums.fill(0.0);
    }
    for chunk in sums.chunks_mut(CHUNK) {
        if chunk.iter().fold(0, |bits, sum| bits | sum.to_bits()) == 0 {
            continue;
        }
        chunk.iter_mut().for_each(|sum| *sum = at_most_one(*sum / top));
        // To the power 1, heights keep their bits.
        if gamma != 1.0 {
            chunk.iter_mut().for_each(|height| *height = power(*height, gamma));
        }
    }
}

#[cfg(test)]
mod tests;
