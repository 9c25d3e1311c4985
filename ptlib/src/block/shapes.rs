//! The three shapes of computation, and how the engine calls a block of each.
//!
//! A block is written as a type over [`Levels`]; here it becomes a factory without generics that a
//! [`BlockSpec`](super::BlockSpec) points to. The engine never sees precision or SIMD level: it
//! gets a [`RowKernel`] that has both inside.

use std::marker::PhantomData;

use super::{InputRows, LogLevel, OutputRow, PrepareContext, RowContext, WholeContext};
use crate::{
    error::{Error, ErrorKind},
    math::{
        levels::{Continuous, EightBit, Levels, Precision},
        simd::{Kernel, SimdLevel},
    },
    params::{ParamSet, ParamValue},
    value::Value,
};

/// A block whose rows come from the same rows of its inputs and the position. The implementing
/// type is what [`prepare`](Self::prepare) made of the parameters: tables, lattices, points.
pub trait PointBlock: Sized + Send + Sync + 'static {
    /// The declared parameters.
    type Params: ParamSet;

    /// Makes what all rows share. Gradients and texts of inputs are there; images are not.
    ///
    /// # Errors
    /// Whatever makes the block fail; the engine adds which block it was.
    fn prepare<L: Levels>(params: &Self::Params, cx: &PrepareContext<'_>) -> Result<Self, Error>;

    /// Writes all of `out`, which may be any part of the row. Mark it `#[inline(always)]`, so that
    /// it is compiled for each SIMD level.
    fn row<L: Levels>(&self, cx: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>);

    /// Whether the output is grey, for outputs declared
    /// [`Planes::ByParameters`](super::Planes::ByParameters).
    fn is_grey(_params: &Self::Params) -> bool {
        true
    }

    /// The most memory that [`prepare`](Self::prepare) takes, in bytes, for images of `width` ×
    /// `height` pixels. Only what grows with the image or with a parameter counts.
    fn scratch_bytes(_params: &Self::Params, _width: u32, _height: u32) -> u64 {
        0
    }
}

/// A block whose rows come from whole inputs. It keeps the images that it reads in
/// [`prepare`](Self::prepare) (cloning an image copies no pixel); inputs that it declares to read
/// at the same row come to [`row`](Self::row).
pub trait GatherBlock: Sized + Send + Sync + 'static {
    /// The declared parameters.
    type Params: ParamSet;

    /// Makes what all rows share: see [`PointBlock::prepare`]. The images of inputs declared
    /// [`anywhere`](super::InputPort::anywhere) are there.
    ///
    /// # Errors
    /// Whatever makes the block fail; the engine adds which block it was.
    fn prepare<L: Levels>(params: &Self::Params, cx: &PrepareContext<'_>) -> Result<Self, Error>;

    /// Writes all of `out`, which is a whole row. Mark it `#[inline(always)]`.
    fn row<L: Levels>(&self, cx: &RowContext<'_>, inputs: &InputRows<'_>, out: &mut OutputRow<'_>);

    /// See [`PointBlock::is_grey`].
    fn is_grey(_params: &Self::Params) -> bool {
        true
    }

    /// The most memory that [`prepare`](Self::prepare) takes, in bytes; `planes` is what its first
    /// input image has.
    fn scratch_bytes(_params: &Self::Params, _width: u32, _height: u32, _planes: usize) -> u64 {
        0
    }
}

/// A block that makes its whole output in one call.
pub trait WholeBlock: 'static {
    /// The declared parameters.
    type Params: ParamSet;

    /// Makes the outputs, in their order. Images have the size of the context unless the block's
    /// essay says otherwise. Long work calls [`check`](super::Context::check) every millisecond.
    ///
    /// # Errors
    /// Whatever makes the block fail; the engine adds which block it was.
    fn compute<L: Levels>(
        params: &Self::Params,
        cx: &WholeContext<'_>,
    ) -> Result<Vec<Value>, Error>;

    /// See [`PointBlock::is_grey`].
    fn is_grey(_params: &Self::Params) -> bool {
        true
    }

    /// The most memory that [`compute`](Self::compute) takes besides its outputs, in bytes.
    fn scratch_bytes(_params: &Self::Params, _width: u32, _height: u32) -> u64 {
        0
    }
}

/// A prepared block of shape Point or Gather: writes rows.
pub trait RowKernel: Send + Sync {
    /// Writes all of `out`. Values are as the block made them: neither clamped nor truncated.
    ///
    /// # Errors
    /// What a block of a plug-in says; the blocks of this library do not fail here.
    fn row(
        &self,
        cx: &RowContext<'_>,
        inputs: &InputRows<'_>,
        out: &mut OutputRow<'_>,
    ) -> Result<(), Error>;

    /// What the block had to say while it wrote rows.
    fn messages(&self) -> Vec<(LogLevel, Error)> {
        Vec::new()
    }
}

/// How the engine computes a block type.
#[derive(Clone, Copy)]
pub(crate) enum Implementation {
    Rows(&'static dyn RowFactory),
    Whole(&'static dyn WholeFactory),
}

impl Implementation {
    pub(crate) fn is_grey(self, values: &[ParamValue]) -> Result<bool, Error> {
        match self {
            Self::Rows(factory) => factory.is_grey(values),
            Self::Whole(factory) => factory.is_grey(values),
        }
    }

    pub(crate) fn scratch_bytes(
        self,
        values: &[ParamValue],
        width: u32,
        height: u32,
        planes: usize,
    ) -> Result<u64, Error> {
        match self {
            Self::Rows(factory) => factory.scratch_bytes(values, width, height, planes),
            Self::Whole(factory) => factory.scratch_bytes(values, width, height),
        }
    }
}

pub(crate) trait RowFactory: Sync {
    fn prepare(
        &self,
        values: &[ParamValue],
        precision: Precision,
        cx: &PrepareContext<'_>,
    ) -> Result<Box<dyn RowKernel>, Error>;
    fn is_grey(&self, values: &[ParamValue]) -> Result<bool, Error>;
    fn scratch_bytes(
        &self,
        values: &[ParamValue],
        width: u32,
        height: u32,
        planes: usize,
    ) -> Result<u64, Error>;
}

pub(crate) trait WholeFactory: Sync {
    fn compute(
        &self,
        values: &[ParamValue],
        precision: Precision,
        cx: &WholeContext<'_>,
    ) -> Result<Vec<Value>, Error>;
    fn is_grey(&self, values: &[ParamValue]) -> Result<bool, Error>;
    fn scratch_bytes(&self, values: &[ParamValue], width: u32, height: u32) -> Result<u64, Error>;
}

fn read<P: ParamSet>(values: &[ParamValue]) -> Result<P, Error> {
    P::read(values).ok_or_else(|| {
        Error::new(ErrorKind::Internal, "the graph holds parameters of other kinds than declared")
    })
}

/// Point and gather blocks differ in what they may read, not in how they are called. Rust has no
/// way to write one factory over two traits of the same methods, so a macro writes it twice.
macro_rules! row_shape {
    ($shape:ident, $block:ident, |$params:ident, $width:ident, $height:ident, $planes:ident| $scratch:expr) => {
        pub(super) struct $shape<B>(PhantomData<fn() -> B>);

        impl<B: $block> $shape<B> {
            pub(super) const FACTORY: Self = Self(PhantomData);
        }

        impl<B: $block> RowFactory for $shape<B> {
            fn prepare(
                &self,
                values: &[ParamValue],
                precision: Precision,
                cx: &PrepareContext<'_>,
            ) -> Result<Box<dyn RowKernel>, Error> {
                struct Prepared<B, L>(B, SimdLevel, PhantomData<fn() -> L>);
                struct Row<'a, 'i, 'o, B, L>(
                    &'a Prepared<B, L>,
                    &'a RowContext<'a>,
                    &'a InputRows<'i>,
                    &'a mut OutputRow<'o>,
                );
                impl<B: $block, L: Levels> Kernel for Row<'_, '_, '_, B, L> {
                    type Output = ();
                    #[inline(always)]
                    fn run(self) {
                        self.0.0.row::<L>(self.1, self.2, self.3);
                    }
                }
                impl<B: $block, L: Levels> RowKernel for Prepared<B, L> {
                    fn row(
                        &self,
                        cx: &RowContext<'_>,
                        inputs: &InputRows<'_>,
                        out: &mut OutputRow<'_>,
                    ) -> Result<(), Error> {
                        self.1.run(Row(self, cx, inputs, out));
                        Ok(())
                    }
                }
                fn boxed<B: $block, L: Levels>(
                    params: &B::Params,
                    cx: &PrepareContext<'_>,
                ) -> Result<Box<dyn RowKernel>, Error> {
                    let block = B::prepare::<L>(params, cx)?;
                    Ok(Box::new(Prepared::<B, L>(block, cx.simd, PhantomData)))
                }
                let params = read(values)?;
                match precision {
                    Precision::EightBit => boxed::<B, EightBit>(&params, cx),
                    Precision::Float => boxed::<B, Continuous>(&params, cx),
                }
            }

            fn is_grey(&self, values: &[ParamValue]) -> Result<bool, Error> {
                Ok(B::is_grey(&read(values)?))
            }

            fn scratch_bytes(
                &self,
                values: &[ParamValue],
                $width: u32,
                $height: u32,
                $planes: usize,
            ) -> Result<u64, Error> {
                let $params = &read(values)?;
                Ok($scratch)
            }
        }
    };
}

row_shape!(Point, PointBlock, |params, width, height, _planes| B::scratch_bytes(
    params, width, height
));
row_shape!(Gather, GatherBlock, |params, width, height, planes| B::scratch_bytes(
    params, width, height, planes
));

pub(super) struct Whole<B>(PhantomData<fn() -> B>);

impl<B: WholeBlock> Whole<B> {
    pub(super) const FACTORY: Self = Self(PhantomData);
}

impl<B: WholeBlock> WholeFactory for Whole<B> {
    fn compute(
        &self,
        values: &[ParamValue],
        precision: Precision,
        cx: &WholeContext<'_>,
    ) -> Result<Vec<Value>, Error> {
        let params = read(values)?;
        match precision {
            Precision::EightBit => B::compute::<EightBit>(&params, cx),
            Precision::Float => B::compute::<Continuous>(&params, cx),
        }
    }

    fn is_grey(&self, values: &[ParamValue]) -> Result<bool, Error> {
        Ok(B::is_grey(&read(values)?))
    }

    fn scratch_bytes(&self, values: &[ParamValue], width: u32, height: u32) -> Result<u64, Error> {
        Ok(B::scratch_bytes(&read(values)?, width, height))
    }
}
