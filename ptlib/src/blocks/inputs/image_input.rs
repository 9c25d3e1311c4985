//! A picture that the caller of the graph gives.
//!
//! A program passes on pixels that it has in memory, such as a photo or a rendered picture. It is
//! stretched to the size of the graph as `load file` does it, but keeps its alpha; a picture of
//! that size comes through as it is. Until the caller sets one, that of the input `default` counts;
//! it is not computed when there is one. A picture is not stored in the graph's file, the name is.
//!
//! The output tiles as far as the picture does.

use crate::block::prelude::*;

const DEFAULT: usize = 0;

params! {
    /// Parameters of [`BLOCK`].
    Params {
        /// What the caller finds this input by. Of several of one name the first counts.
        name: text = "image";
        /// How the picture is brought to the size of the graph.
        interpolation: choice [Interpolation] = Interpolation::Linear;
    }
}

/// The block as everybody else sees it.
pub static BLOCK: BlockSpec = BlockSpec::whole::<ImageInput>(About {
    id: "image input",
    summary: "A picture that the caller of the graph gives, stretched to the size of the graph.",
    inputs: &[input("default", Kind::Image).optional()],
    outputs: &[output("image", Planes::As(DEFAULT))],
    role: Role::Input,
    tiling: Tiling::Except("a picture tiles only if the one that the caller gives does"),
    ..About::DEFAULT
});

struct ImageInput;

impl WholeBlock for ImageInput {
    type Params = Params;

    fn compute<L: Levels>(params: &Params, cx: &WholeContext<'_>) -> Result<Vec<Value>, Error> {
        let value = cx.given_or(DEFAULT)?;
        let Value::Image(picture) = value else { return Ok(vec![value.clone()]) };
        if (picture.width(), picture.height()) == (cx.width, cx.height) {
            return Ok(vec![value.clone()]);
        }
        let image = cx.stretched::<L>(picture, picture.planes(), params.interpolation)?;
        Ok(vec![image.into()])
    }

    fn scratch_bytes(_: &Params, width: u32, height: u32) -> u64 {
        Resampling::bytes_of((width, height))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::block::testing::{Trial, image_of_levels};

    #[test]
    fn a_picture_of_the_right_size_comes_through_as_it_is() {
        let given = image_of_levels(3, &[&[0, 1, 2, 253, 254, 255]]);
        let trial = Trial::of(&BLOCK).size(3, 2).given(given.clone());
        let Value::Image(image) = trial.compute().unwrap().swap_remove(0) else { panic!() };
        assert_eq!(image.channel(0), given.channel(0));
    }

    #[test]
    fn a_picture_of_another_size_is_stretched_as_load_file_does_it() {
        let given = image_of_levels(2, &[&[0, 200], &[10, 20], &[7, 7], &[255, 0]]);
        let trial = Trial::of(&BLOCK).size(4, 1).given(given);
        let nearest = trial.clone().choice("interpolation", 0);
        assert_eq!(nearest.image().planes(), 4);
        assert_eq!(nearest.levels(0), [0, 200, 200, 0]);
        assert_eq!(nearest.levels(3), [255, 0, 0, 255]);
        assert_ne!(trial.levels(0), nearest.levels(0));
    }

    #[test]
    fn the_default_counts_until_the_caller_gives_one() {
        let [default, given] = [[10, 20], [30, 40]].map(|row| image_of_levels(2, &[&row]));
        let trial = Trial::of(&BLOCK).size(2, 1).input(DEFAULT, default);
        let red = |trial: &Trial| {
            let Value::Image(image) = trial.compute().unwrap().swap_remove(0) else { panic!() };
            convert::to_byte(image.channel(0)[1])
        };
        assert_eq!(red(&trial), 20);
        assert_eq!(red(&trial.given(given)), 40);
    }
}
