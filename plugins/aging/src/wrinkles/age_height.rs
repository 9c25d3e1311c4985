//! Ages a height map: between a young one and an old one, where a mask lets it.
//!
//! Masks act on heights, before normals are made of them, so that slopes and parallax agree. At
//! age 0 the young map comes out bit for bit.

use ptlib_plugin::prelude::*;

const OLD: usize = 0;
const MASK: usize = 1;
const YOUNG: usize = 2;

params! {
    /// Parameters of `age height`.
    Params {
        /// The age: 0 gives the young heights, 1 the old ones.
        age: float [hard 0.0..=1.0 soft 0.0..=1.0] = 1.0;
    }
}

/// The block, prepared.
#[derive(Debug)]
pub struct AgeHeight {
    age: f32,
}

impl Block for AgeHeight {
    type Params = Params;

    const ABOUT: About = About {
        id: c"aging.age height",
        name: c"Age height",
        category: c"wrinkles",
        summary: c"Deepens wrinkles with age: between young heights and old ones, under a mask.",
        inputs: &[
            &input(c"old", Kind::Image),
            &input(c"mask", Kind::Image).optional(),
            &input(c"young", Kind::Image).optional(),
        ],
        outputs: &[&output(c"image", Planes::Grey)],
        shape: Shape::Point,
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { age: math::single(params.age) })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let old = call.image(OLD)?;
        let [mask, young] = [MASK, YOUNG].map(|input| call.optional_image(input));
        let mut out = call.output(0)?;
        for y in 0..out.height() {
            let [mask, young] = [mask, young].map(|image| image.map(|image| image.row(0, y)));
            for (x, (out, &old)) in out.row_mut(0, y).iter_mut().zip(old.row(0, y)).enumerate() {
                let young = young.map_or(0.0, |row| row[x]);
                let mask = mask.map_or(1.0, |row| row[x]);
                *out = young + (old - young) * (self.age * mask);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use ptlib::{ComputeOptions, params::ParamValue};

    use crate::testing;

    #[test]
    fn a_quarter_of_the_way_is_a_quarter() {
        let engine = testing::engine();
        let mut graph = engine.new_graph();
        let [old, young] = [204, 51].map(|level| {
            let fill = graph.add("color fill").unwrap();
            graph.set(fill, "red", ParamValue::Int(level)).unwrap();
            fill
        });
        let block = graph.add("aging.age height").unwrap();
        graph.set(block, "age", ParamValue::Float(0.25)).unwrap();
        graph.connect(old, 0, block, 0).unwrap();
        graph.connect(young, 0, block, 2).unwrap();
        let options = ComputeOptions { size: Some((4, 4)), ..Default::default() };
        let image = engine.compute(&graph, block, 0, options).unwrap();
        assert!(image.channel(0).iter().all(|value| (value - 0.35).abs() < 1e-6));
    }
}
