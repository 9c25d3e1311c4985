//! A block that takes its time, to be watched and cancelled.

use std::time::Duration;

use crate::block::prelude::*;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// How long it takes.
        milliseconds: int [hard 0..=600000 soft 0..=1000 unit "ms"] = 1000;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<Slow>(About {
    id: "test slow",
    summary: "Black, after a while.",
    outputs: &[output("image", Planes::Grey)],
    ..About::DEFAULT
});

struct Slow;

impl WholeBlock for Slow {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        for millisecond in 0..params.milliseconds {
            cx.check()?;
            cx.report(f64::from(millisecond) / f64::from(params.milliseconds));
            std::thread::sleep(Duration::from_millis(1));
        }
        let mut image = cx.new_image(1)?;
        image.planes_mut().for_each(|plane| plane.fill(0.0));
        Ok(vec![image.into()])
    }
}
