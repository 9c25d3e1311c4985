//! A plug-in for ptlib in Rust: one block that makes an image black and white.
//!
//! Copy this folder, and change the vendor, the block's description, its parameters, and what it
//! computes.

use ptlib_plugin::prelude::*;

params! {
    /// Parameters of the threshold.
    Params {
        /// Values below it become black, others white.
        level: float [hard 0.0..=1.0 soft 0.0..=1.0] = 0.5;
    }
}

/// The block, prepared: what its parameters became.
#[derive(Debug)]
pub struct Threshold {
    level: f32,
}

impl Block for Threshold {
    type Params = Params;

    const ABOUT: About = About {
        id: c"my-vendor.threshold",
        category: c"adjust",
        summary: c"Black where an image is below a level, white elsewhere.",
        inputs: &[&input(c"image", Kind::Image).doc(c"What is divided.")],
        outputs: &[&output(c"image", Planes::AsInput(0))],
        ..About::DEFAULT
    };

    fn prepare(params: &Params, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self { level: math::single(params.level) })
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let image = call.image(0)?;
        let mut out = call.output(0)?;
        for channel in 0..out.channels() {
            for y in 0..out.height() {
                let pairs = out.row_mut(channel, y).iter_mut().zip(image.row(channel, y));
                pairs.for_each(|(out, value)| *out = if *value >= self.level { 1.0 } else { 0.0 });
            }
        }
        Ok(())
    }
}

export_plugin! {
    id: c"my-vendor",
    name: c"My blocks",
    vendor: c"My vendor",
    license: c"MIT OR Apache-2.0",
    blocks: [Threshold],
}

#[cfg(test)]
mod tests {
    use ptlib::{ComputeOptions, Engine, EngineOptions};

    #[test]
    #[allow(unsafe_code, reason = "the tables of the plug-in are given as a pointer")]
    fn an_image_becomes_black_and_white() {
        let engine = Engine::new(EngineOptions::default());
        // SAFETY: the entry is a static of this crate, made by the SDK.
        unsafe { engine.register_plugin(&raw const super::ptl_plugin_entry_v1) }.unwrap();
        let mut graph = engine.new_graph();
        let noise = graph.add("perlin noise").unwrap();
        let threshold = graph.add("my-vendor.threshold").unwrap();
        graph.connect(noise, 0, threshold, 0).unwrap();
        let options = || ComputeOptions { size: Some((32, 16)), ..Default::default() };
        let grey = engine.compute(&graph, noise, 0, options()).unwrap();
        let image = engine.compute(&graph, threshold, 0, options()).unwrap();
        let expected: Vec<f32> =
            grey.channel(0).iter().map(|value| if *value >= 0.5 { 1.0 } else { 0.0 }).collect();
        assert_eq!(image.channel(0), expected);
        assert!(expected.contains(&0.0) && expected.contains(&1.0));
    }
}
