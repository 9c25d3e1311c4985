//! For the tests of blocks: computes one block by itself, as the engine would.

use std::sync::{Arc, Mutex};

use super::{
    Access, BlockSpec, Context, Files, Implementation, InputRows, LogLevel, OutputRow, PlaneCounts,
    Planes, PortRow, Progress, RowContext, Shape, Store,
};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
    math::{levels::Precision, simd::SimdLevel},
    params::ParamValue,
    value::{BufferPool, Draft, Image, MAX_PLANES, StreamPlan, StreamShape, Value, WordsPlan},
};

/// A triangle with a corner at (size, 0, 0).
pub(crate) fn mesh(size: f32) -> Value {
    let (draft, limits) = draft(size, |plan, limits| {
        Draft::mesh(3, WordsPlan::New(3), plan, limits).expect("within the limits")
    });
    draft.finish(&limits).expect("a right mesh")
}

/// Three points, one at (size, 0, 0).
pub(crate) fn points(size: f32) -> Value {
    let (draft, limits) =
        draft(size, |plan, limits| Draft::points(3, plan, limits).expect("within the limits"));
    draft.finish(&limits).expect("right points")
}

/// One strand of three points, one at (size, 0, 0).
pub(crate) fn strands(size: f32) -> Value {
    let (mut draft, limits) = draft(size, |plan, limits| {
        Draft::strands(3, WordsPlan::New(2), plan, vec![], limits).expect("within the limits")
    });
    draft.numbers_mut().expect("new")[1] = 3;
    draft.finish(&limits).expect("right strands")
}

fn draft(size: f32, make: impl Fn(Vec<StreamPlan>, &Limits) -> Draft) -> (Draft, Limits) {
    let limits = Limits::default();
    let mut draft = make(vec![StreamPlan::New(StreamShape::floats("position", 3))], &limits);
    draft.stream_mut(0).expect("new")[3] = size.to_bits();
    (draft, limits)
}

/// One computation of one block: `Trial::of(&BLOCK).size(8, 4).int("amplitude", 3).image()`.
/// Starts from the block's defaults, 64 × 64 pixels, seed 0, float precision.
#[derive(Clone)]
pub(crate) struct Trial {
    spec: &'static BlockSpec,
    values: Vec<ParamValue>,
    inputs: Vec<Option<Value>>,
    width: u32,
    height: u32,
    seed: u64,
    precision: Precision,
    simd: SimdLevel,
    piece: usize,
    files: OneFile,
    given: Option<Value>,
    limits: Limits,
}

impl Trial {
    pub(crate) fn of(spec: &'static BlockSpec) -> Self {
        Self {
            spec,
            values: spec.params.iter().map(crate::params::ParamSpec::default_value).collect(),
            inputs: vec![None; spec.about.inputs.len()],
            width: 64,
            height: 64,
            seed: 0,
            precision: Precision::Float,
            simd: SimdLevel::best(),
            piece: usize::MAX,
            files: OneFile(None),
            given: None,
            limits: Limits::default(),
        }
    }

    pub(crate) fn size(mut self, width: u32, height: u32) -> Self {
        (self.width, self.height) = (width, height);
        self
    }

    pub(crate) fn seed(mut self, seed: u64) -> Self {
        self.seed = seed;
        self
    }

    /// Computes in levels k/255.
    pub(crate) fn eight_bit(mut self) -> Self {
        self.precision = Precision::EightBit;
        self
    }

    pub(crate) fn simd(mut self, simd: SimdLevel) -> Self {
        self.simd = simd;
        self
    }

    /// Asks for rows in pieces of that many pixels.
    pub(crate) fn pieces(mut self, piece: usize) -> Self {
        self.piece = piece;
        self
    }

    pub(crate) fn input(mut self, port: usize, value: impl Into<Value>) -> Self {
        self.inputs[port] = Some(value.into());
        self
    }

    /// What the caller of the graph sets.
    pub(crate) fn given(mut self, value: impl Into<Value>) -> Self {
        self.given = Some(value.into());
        self
    }

    /// Whatever path the block reads leads to a file of this content.
    pub(crate) fn file(mut self, content: &[u8]) -> Self {
        self.files = OneFile(Some(content.into()));
        self
    }

    /// Lets texts of L-systems have that many symbols.
    pub(crate) fn max_text_symbols(mut self, symbols: u32) -> Self {
        self.limits.text_symbols = symbols;
        self
    }

    pub(crate) fn int(self, id: &str, value: i32) -> Self {
        self.set(id, ParamValue::Int(value))
    }

    pub(crate) fn float(self, id: &str, value: f64) -> Self {
        self.set(id, ParamValue::Float(value))
    }

    pub(crate) fn flag(self, id: &str, value: bool) -> Self {
        self.set(id, ParamValue::Bool(value))
    }

    pub(crate) fn choice(self, id: &str, number: u32) -> Self {
        self.set(id, ParamValue::Choice(number))
    }

    pub(crate) fn text(self, id: &str, value: &str) -> Self {
        self.set(id, ParamValue::Text(value.into()))
    }

    fn set(mut self, id: &str, value: ParamValue) -> Self {
        let (place, spec) = self.spec.param(id).expect("the block has that parameter");
        spec.check(&value).expect("the parameter allows that value");
        self.values[place] = value;
        self
    }

    /// The block's first output, an image.
    pub(crate) fn image(&self) -> Image {
        match self.compute().expect("the block computes").swap_remove(0) {
            Value::Image(image) => image,
            other => panic!("gives a {}", other.kind().name()),
        }
    }

    /// The levels 0..255 of a channel of the block's first output, in 8-bit precision.
    pub(crate) fn levels(&self, channel: usize) -> Vec<u8> {
        let image = self.clone().eight_bit().image();
        image.channel(channel).iter().map(|value| crate::math::convert::to_byte(*value)).collect()
    }

    /// Fails unless the block gives the same bits at every SIMD level and, for a block of shape
    /// Point, for rows in odd pieces. (Others are asked for whole rows only.)
    pub(crate) fn assert_same_bits(&self) {
        let expected = self.image();
        let pieces = if self.spec.shape() == Shape::Point { 4 } else { 1 };
        for simd in SimdLevel::available() {
            for piece in [usize::MAX, 1, 7, 16].into_iter().take(pieces) {
                let image = self.clone().simd(simd).pieces(piece).image();
                for channel in 0..expected.planes() {
                    let pairs = image.channel(channel).iter().zip(expected.channel(channel));
                    for (i, (value, expected)) in pairs.enumerate() {
                        let place = (i % self.width as usize, i / self.width as usize);
                        let how = (simd.name(), piece);
                        assert_eq!(value.to_bits(), expected.to_bits(), "{place:?} {how:?}");
                    }
                }
            }
        }
    }

    /// All outputs of the block.
    pub(crate) fn compute(&self) -> Result<Vec<Value>, Error> {
        self.compute_and_tell(&|_, _| ())
    }

    /// The block's first output, a text, and what the block warned of on the way.
    pub(crate) fn text_and_warnings(&self) -> Result<(String, Vec<String>), Error> {
        let warnings = Mutex::new(Vec::new());
        let tell = |_, what: Error| warnings.lock().expect("no panic").push(what.to_string());
        let value = self.compute_and_tell(&tell)?.swap_remove(0);
        let Value::Text(text) = value else { panic!("gives a {}", value.kind().name()) };
        Ok((text.to_string(), warnings.into_inner().expect("no panic")))
    }

    fn compute_and_tell(
        &self,
        tell: &(dyn Fn(LogLevel, Error) + Sync),
    ) -> Result<Vec<Value>, Error> {
        let mut values = self.with_context(tell, |cx| match self.spec.implementation {
            Implementation::Whole(factory) => factory.compute(&self.values, self.precision, cx),
            Implementation::Rows(_) => Ok(vec![Value::Image(self.rows(cx)?)]),
        })?;
        if let Implementation::Whole(_) = self.spec.implementation {
            for (value, port) in values.iter_mut().zip(self.spec.about.outputs) {
                if let Value::Image(image) = value {
                    let store = Store::of(self.precision, port.is_free);
                    *image = image.clone().map_planes(&BufferPool::new(), |plane| {
                        store.apply(self.simd, plane);
                        Ok(())
                    })?;
                }
            }
        }
        Ok(values)
    }

    /// Runs something with the context that the block would get.
    pub(crate) fn with_context<T>(
        &self,
        tell: &(dyn Fn(LogLevel, Error) + Sync),
        run: impl FnOnce(&Context<'_>) -> T,
    ) -> T {
        let inputs: Vec<_> = (0..self.inputs.len()).map(|port| self.whole(port)).collect();
        let connected: Vec<_> = self.inputs.iter().map(Option::is_some).collect();
        let planes = |value: &Option<Value>| match value {
            Some(Value::Image(image)) => image.planes(),
            _ => 0,
        };
        let input_planes: Vec<_> = self.inputs.iter().map(planes).collect();
        let output_planes = self.planes().unwrap_or(0);
        run(&Context {
            width: self.width,
            height: self.height,
            seed: self.seed,
            simd: self.simd,
            inputs: &inputs,
            connected: &connected,
            given: self.given.as_ref(),
            pool: &BufferPool::new(),
            files: &self.files,
            progress: &Alone,
            limits: &self.limits,
            planes: PlaneCounts { inputs: &input_planes, outputs: &[output_planes] },
            tell,
        })
    }

    /// The input as `prepare` and `compute` see it.
    fn whole(&self, port: usize) -> Option<Value> {
        let value = self.inputs[port].clone()?;
        let is_row = matches!(value, Value::Image(_)) && self.spec.access(port) == Access::SameRow;
        if is_row { None } else { Some(value) }
    }

    fn rows(&self, context: &Context<'_>) -> Result<Image, Error> {
        let Implementation::Rows(factory) = self.spec.implementation else {
            unreachable!("called for blocks that write rows")
        };
        let kernel = factory.prepare(&self.values, self.precision, context)?;
        let mut image = context.new_image(self.planes()?)?;
        let stores =
            vec![Store::of(self.precision, self.spec.about.outputs[0].is_free); image.planes()];
        let columns = self.width as usize;
        let mut planes: Vec<&mut [f32]> = image.planes_mut().collect();
        for y in 0..self.height {
            for x in (0..columns).step_by(self.piece.min(columns)) {
                let len = self.piece.min(columns - x);
                let ports: Vec<_> =
                    (0..self.inputs.len()).map(|i| self.row(i, x, y, len)).collect();
                let out = planes.iter_mut().map(|plane| {
                    let start = y as usize * columns + x;
                    &mut plane[start..start + len]
                });
                let x = u32::try_from(x).expect("a column of an image");
                let (width, height) = (self.width, self.height);
                let place = RowContext { x, y, width, height, progress: &Alone };
                let mut out = OutputRow::new(out, &stores);
                kernel.row(&place, &InputRows::new(&ports), &mut out).expect("rows do not fail");
                out.finish(self.simd);
            }
        }
        Ok(image)
    }

    fn row(&self, port: usize, x: usize, y: u32, len: usize) -> PortRow<'_> {
        match &self.inputs[port] {
            Some(Value::Image(image)) if self.spec.access(port) == Access::SameRow => {
                PortRow::new((0..image.planes()).map(|plane| &image.row(plane, y)[x..x + len]))
            }
            _ => PortRow::default(),
        }
    }

    fn planes(&self) -> Result<usize, Error> {
        let of = |port: &usize| match &self.inputs[*port] {
            Some(Value::Image(image)) => image.planes(),
            _ => 1,
        };
        Ok(match self.spec.about.outputs[0].planes {
            Planes::Grey => 1,
            Planes::Colour => 3,
            Planes::ColourAlpha => 4,
            Planes::As(port) => of(&port),
            Planes::Most(ports) => ports.iter().map(of).max().unwrap_or(1).min(MAX_PLANES),
            Planes::ByParameters => {
                if self.spec.implementation.is_grey(&self.values)? {
                    1
                } else {
                    3
                }
            }
        })
    }
}

/// An image of `width` columns whose planes hold these levels 0..255, row by row.
pub(crate) fn image_of_levels(width: u32, planes: &[&[u8]]) -> Image {
    let height = u32::try_from(planes[0].len()).expect("a small image") / width;
    let mut image = Image::new(&BufferPool::new(), width, height, planes.len()).expect("memory");
    for (plane, levels) in image.planes_mut().zip(planes) {
        for (value, level) in plane.iter_mut().zip(*levels) {
            *value = f32::from(*level) / 255.0;
        }
    }
    image
}

/// The file that every path leads to.
#[derive(Clone)]
struct OneFile(Option<Arc<[u8]>>);

impl Files for OneFile {
    fn read(&self, path: &str) -> Result<Arc<[u8]>, Error> {
        self.0.clone().ok_or_else(|| {
            Error::new(ErrorKind::Denied, format!("a trial reads no file, not \"{path}\""))
        })
    }

    fn read_image(&self, path: &str, _: &Arc<BufferPool>) -> Result<Image, Error> {
        Err(Error::new(ErrorKind::Denied, format!("a trial reads no file, not \"{path}\"")))
    }

    fn write(&self, path: &str, _: &[u8]) -> Result<(), Error> {
        Err(Error::new(ErrorKind::Denied, format!("a trial writes no file, not \"{path}\"")))
    }
}

/// The calling thread by itself, never cancelled.
struct Alone;

impl Progress for Alone {
    fn check(&self) -> Result<(), Error> {
        Ok(())
    }

    fn parallel(
        &self,
        count: usize,
        task: &(dyn Fn(usize) -> Result<(), Error> + Sync),
    ) -> Result<(), Error> {
        // Backwards: no task may need an earlier one.
        (0..count).rev().try_for_each(task)
    }

    fn report(&self, _: f64) {}
}
