//! Blocks that use what is left of the values: one makes them wrongly, one takes all kinds and
//! passes what it does not know, one tells what it sees, and an input of graphs.

use ptlib_plugin::{
    AnyStream,
    prelude::*,
    stream::{COLOR, POSITION, RADIUS},
};

choice! {
    /// What is wrong.
    Fault {
        /// Nothing.
        Nothing = "nothing",
        /// More points than are allowed.
        Many = "many",
        /// More points than can be counted.
        Uncountable = "uncountable",
        /// A position that is not a number.
        Number = "number",
        /// They are not finished.
        Unfinished = "unfinished",
        /// They are begun twice at a time.
        Twice = "twice",
        /// They are dropped and begun again, often, which is right.
        Again = "again",
        /// A panic while they are written.
        Panic = "panic",
        /// A text where points are declared.
        Kind = "kind",
        /// An output that does not exist.
        Output = "output",
        /// More scratch memory than is allowed.
        Scratch = "scratch",
    }
}

params! {
    /// Parameters of [`Faulty`].
    FaultParams {
        /// What is wrong.
        fault: choice [Fault] = Fault::Nothing;
    }
}

/// Ten points, or what is wrong.
pub struct Faulty(Fault);

impl Block for Faulty {
    type Params = FaultParams;

    const ABOUT: About = About {
        id: c"ptlib-rust.faulty",
        category: c"testing",
        summary: c"Ten points, or an error.",
        shape: Shape::Whole,
        outputs: &[&output(c"points", Planes::Grey).of_kind(Kind::Points)],
        ..About::DEFAULT
    };

    fn prepare(params: &FaultParams, _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self(params.fault))
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let count = match self.0 {
            Fault::Many => 4_000_000_000,
            Fault::Uncountable => usize::MAX,
            _ => 10,
        };
        let streams = (POSITION, RADIUS.constant(0.5));
        match self.0 {
            Fault::Kind => return call.give_text(0, "a text"),
            Fault::Output => return call.new_points(1, 1, POSITION)?.finish(),
            Fault::Scratch => drop(call.work().scratch::<[f64; 4]>(usize::MAX / 64)?),
            Fault::Again => {
                for _ in 0..1000 {
                    let mut scratch = call.work().scratch::<u64>(1 << 20)?;
                    scratch[1 << 19] = 1;
                    let mut points = call.new_points(0, 1 << 20, POSITION)?;
                    points.streams()[1 << 19] = [1.0; 3];
                }
            }
            _ => {}
        }
        let mut points = call.new_points(0, count, streams)?;
        points.fill(|first, (positions, ())| {
            assert!(self.0 != Fault::Panic, "piece {first}");
            positions.iter_mut().zip(1_u8..).for_each(|(to, i)| *to = [f32::from(i); 3]);
            if self.0 == Fault::Number {
                positions[3][1] = f32::NAN;
            }
            Ok(())
        })?;
        match self.0 {
            Fault::Unfinished => Ok(()),
            Fault::Twice => call.new_points(0, count, POSITION)?.finish(),
            _ => points.finish(),
        }
    }
}

/// Colours a mesh and points by a colour transition along the height, and passes strands on.
pub struct Tint;

impl Block for Tint {
    type Params = ();

    const ABOUT: About = About {
        id: c"ptlib-rust.tint",
        category: c"testing",
        summary: c"Colours by height; each input is optional.",
        shape: Shape::Whole,
        inputs: &[
            &input(c"mesh", Kind::Mesh).optional(),
            &input(c"colors", Kind::Gradient).optional(),
            &input(c"words", Kind::Text).optional(),
        ],
        outputs: &[
            &output(c"mesh", Planes::Grey).of_kind(Kind::Mesh),
            &output(c"colors", Planes::Grey).of_kind(Kind::Gradient),
            &output(c"words", Planes::Grey).of_kind(Kind::Text),
            &output(c"copy", Planes::Grey).of_kind(Kind::Mesh),
        ],
        ..About::DEFAULT
    };

    fn prepare((): &(), _: &Setup<'_>) -> Result<Self, BlockError> {
        Ok(Self)
    }

    fn compute(&self, call: &mut Call<'_>) -> Result<(), BlockError> {
        let Some(mesh) = call.optional_mesh(0) else {
            // A mesh of nothing is a mesh.
            call.new_mesh(0, 0, Triangles::New(0), POSITION)?.finish()?;
            call.new_mesh(3, 0, Triangles::New(0), POSITION)?.finish()?;
            call.give_gradient(1, &[])?;
            return call.give_text(2, "nothing");
        };
        let colors = call.gradient(1)?;
        let [low, high] = mesh.bounds().map(|corner| corner[2]);
        let positions = mesh.positions()?;
        let streams = (mesh.streams(), COLOR);
        let mut tinted = call.new_mesh(0, mesh.vertex_count(), Triangles::Of(mesh), streams)?;
        tinted.fill(|first, ((), tints)| {
            for (i, tint) in tints.iter_mut().enumerate() {
                *tint = colors.color_at((positions.get(first + i)[2] - low) / (high - low));
            }
            Ok(())
        })?;
        // All numbers copied one by one, streams of any type, triangles turned around.
        let likes: Vec<_> = mesh.streams().iter().map(AnyStream::like).collect();
        let triangles = Triangles::New(mesh.triangles().len());
        let mut copy = call.new_mesh(3, mesh.vertex_count(), triangles, likes)?;
        for (to, from) in copy.triangles().iter_mut().zip(mesh.triangles()) {
            *to = [from[2], from[1], from[0]];
        }
        copy.fill(|first, mut slices| {
            for (to, from) in slices.iter_mut().zip(mesh.streams().iter()) {
                for i in first..from.len().min(first + to.count()) {
                    to.element(i - first).copy_from_slice(from.bits(i));
                }
            }
            Ok(())
        })?;
        tinted.finish()?;
        copy.finish()?;
        call.pass(1, 1)?;
        let words = call.optional_text(2).unwrap_or("no words");
        call.give_text(2, &format!("{words}: {} vertices", mesh.vertex_count()))
    }
}

params! {
    /// Parameters of [`Head`].
    HeadParams {
        /// What the caller finds it by.
        name: text = "head";
    }
}

/// A mesh that the caller of the graph gives.
pub struct Head;

impl GraphInput for Head {
    type Params = HeadParams;

    const ABOUT: About = About {
        id: c"ptlib-rust.head",
        category: c"testing",
        summary: c"A mesh that the caller of the graph gives.",
        outputs: &[&output(c"mesh", Planes::Grey).of_kind(Kind::Mesh)],
        ..About::DEFAULT
    };
}
