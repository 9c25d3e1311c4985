//! Values that a plug-in makes for its outputs: the service `ptl.values/1`.
//!
//! The memory is the host's from the start ([`Draft`]), so a plug-in that fails has nothing to
//! free, and nothing is copied. What comes out is checked like everything from outside.

use std::{
    ffi::{CString, c_char, c_void},
    ptr,
    sync::{Arc, Mutex, MutexGuard, PoisonError},
};

use ptlib_plugin_abi::{services::*, values::*, *};

use super::{
    call::{Call, call_of},
    host::guarded,
    import::{Import, read, shape_of, stream_pointers, zero},
};
use crate::{
    error::{Error, ErrorKind},
    limits::Limits,
    math::convert::count,
    value::{BufferPool, Draft, Kind, Stream, StreamPlan, Value, Words, WordsPlan},
};

/// What a call of `compute` makes besides images.
pub(super) struct Making<'a> {
    /// The kind of each output.
    kinds: &'a [Kind],
    /// What parts may be shared from.
    inputs: &'a [Option<Value>],
    /// Where the memory of new values comes from.
    pool: &'a Arc<BufferPool>,
    outputs: Mutex<Vec<Output>>,
}

/// An output while it is made.
#[derive(Default)]
enum Output {
    #[default]
    Nothing,
    Begun(Box<Begun>),
    Made(Value),
}

/// A value that the plug-in writes, and the tables that lead it there.
struct Begun {
    draft: Draft,
    lists: [Streams; 2],
}

/// An array of pointers to streams.
#[derive(Default)]
struct Streams {
    pointers: Box<[*const ptl_stream]>,
    _streams: Box<[ptl_stream]>,
    _ids: Vec<CString>,
}

// SAFETY: the pointers lead to boxes of the same object and to the memory of its draft.
unsafe impl Send for Streams {}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn wrong(message: impl Into<String>) -> Error {
    Error::new(ErrorKind::InvalidArgument, message)
}

impl<'a> Making<'a> {
    pub(super) fn new(
        kinds: &'a [Kind],
        inputs: &'a [Option<Value>],
        pool: &'a Arc<BufferPool>,
    ) -> Self {
        let outputs = kinds.iter().map(|_| Output::Nothing).collect();
        Self { kinds, inputs, pool, outputs: Mutex::new(outputs) }
    }

    /// What was made for an output.
    ///
    /// # Errors
    /// [`ErrorKind::PluginFailed`] if nothing was, or it was not finished.
    pub(super) fn take(&self, output: usize) -> Result<Value, Error> {
        let made = lock(&self.outputs).get_mut(output).map(std::mem::take);
        let what = match made {
            Some(Output::Made(value)) => return Ok(value),
            Some(Output::Begun(_)) => "began a value and did not finish it",
            Some(Output::Nothing) | None => "made no value",
        };
        Err(Error::new(ErrorKind::PluginFailed, format!("{what} for output {output}")))
    }

    fn put(&self, output: u32, made: Output, kind: Kind) -> Result<(), Error> {
        match self.kinds.get(output as usize) {
            Some(declared) if *declared == kind => {}
            Some(declared) => {
                let (declared, kind) = (declared.name(), kind.name());
                let message = format!("output {output} gives a {declared}, not a {kind}");
                return Err(Error::new(ErrorKind::TypeMismatch, message));
            }
            None => return Err(wrong(format!("there is no output {output}"))),
        }
        lock(&self.outputs)[output as usize] = made;
        Ok(())
    }

    /// Notes a value that was begun, and gives the tables that lead to it.
    fn begin(
        &self,
        output: u32,
        mut draft: Draft,
        plans: [Vec<StreamPlan>; 2],
    ) -> Result<(*const u32, [*const *const ptl_stream; 2]), Error> {
        let [streams, strand_streams] = plans;
        let lists = [
            Streams::of(&streams, |place| draft.stream_mut(place).map(<[u32]>::as_mut_ptr)),
            Streams::of(&strand_streams, |place| {
                draft.strand_stream_mut(place).map(<[u32]>::as_mut_ptr)
            }),
        ];
        let numbers = draft.numbers_mut().map_or(ptr::null(), |numbers| numbers.as_ptr());
        let pointers = lists.each_ref().map(|list| list.pointers.as_ptr());
        let kind = draft.kind();
        self.put(output, Output::Begun(Box::new(Begun { draft, lists })), kind)?;
        Ok((numbers, pointers))
    }

    fn finish(&self, output: u32, limits: &Limits) -> Result<(), Error> {
        let begun = lock(&self.outputs).get_mut(output as usize).map(std::mem::take);
        let Some(Output::Begun(begun)) = begun else {
            return Err(wrong(format!("nothing was begun for output {output}")));
        };
        let Begun { draft, lists } = *begun;
        drop(lists);
        let kind = draft.kind();
        let value = draft.finish(limits).map_err(|error| {
            let message = format!("output {output}: {}", error.message());
            Error::new(error.kind(), message)
        })?;
        self.put(output, Output::Made(value), kind)
    }

    /// The streams of a template: new ones, and those of inputs that it points to.
    ///
    /// # Safety
    /// The contract.
    unsafe fn plans(
        &self,
        streams: *const *const ptl_stream,
        count: u32,
        limits: &Limits,
    ) -> Result<Vec<StreamPlan>, Error> {
        // SAFETY: the contract.
        let pointers = unsafe { stream_pointers(streams, count, "streams", limits) }?;
        let plan = |(number, stream): (usize, &*const ptl_stream)| {
            let name = format!("streams[{number}]");
            let template = stream.cast::<ptl_stream>();
            if template.is_null() || !template.is_aligned() {
                return Err(wrong(format!("`{name}` leads to no stream")));
            }
            // SAFETY: the contract: not NULL, aligned.
            let template = unsafe { &*template };
            // SAFETY: the contract.
            let shape = unsafe { shape_of(template, &name) }?;
            let has_stride = |given: usize| match template.stride {
                0 => Ok(()),
                stride if stride == given => Ok(()),
                stride => {
                    let message = format!("`{name}.stride` is {stride}, allowed are 0 and {given}");
                    Err(wrong(message))
                }
            };
            if template.data.is_null() {
                has_stride(shape.components as usize * size_of::<u32>())?;
                return Ok(StreamPlan::New(shape));
            }
            let shared = self.streams_of_inputs().find(|stream| {
                let data: *const u32 = stream.data().as_ptr();
                ptr::eq(data.cast::<c_void>(), template.data) && *stream.shape() == shape
            });
            let message =
                || format!("`{name}.data` is of no stream of an input of that id and type");
            let shared = shared.ok_or_else(|| wrong(message()))?;
            has_stride(shared.stride())?;
            Ok(StreamPlan::Shared(shared.clone()))
        };
        pointers.iter().enumerate().map(plan).collect()
    }

    fn streams_of_inputs(&self) -> impl Iterator<Item = &Stream> {
        self.inputs.iter().flatten().flat_map(|value| match value {
            Value::Mesh(mesh) => mesh.streams().iter().chain(&[]),
            Value::Points(points) => points.streams().iter().chain(&[]),
            Value::Strands(strands) => {
                strands.point_streams().iter().chain(strands.strand_streams())
            }
            _ => [].iter().chain(&[]),
        })
    }

    /// Whole numbers: `len` new ones, or those of an input that a template points to.
    fn numbers(&self, wanted: *const u32, len: u32, name: &str) -> Result<WordsPlan, Error> {
        if wanted.is_null() {
            return Ok(WordsPlan::New(len));
        }
        let words = self.inputs.iter().flatten().filter_map(|value| match value {
            Value::Mesh(mesh) => Some(mesh.indices()),
            Value::Strands(strands) => Some(strands.first_point()),
            _ => None,
        });
        let is_wanted = |words: &&Words| words.as_ptr() == wanted && words.len() == len as usize;
        let found = words.into_iter().find(is_wanted);
        let message =
            || format!("`{name}` is neither NULL nor that of an input with {len} entries");
        Ok(WordsPlan::Shared(found.ok_or_else(|| wrong(message()))?.clone()))
    }
}

impl Streams {
    fn of(plans: &[StreamPlan], mut start: impl FnMut(usize) -> Option<*mut u32>) -> Self {
        let shapes = plans.iter().map(|plan| match plan {
            StreamPlan::New(shape) => (shape, shape.components as usize * size_of::<u32>()),
            StreamPlan::Shared(stream) => (stream.shape(), stream.stride()),
        });
        let ids: Vec<CString> =
            shapes.clone().map(|(shape, _)| CString::new(&*shape.id).unwrap_or_default()).collect();
        let streams =
            shapes.zip(plans).zip(&ids).enumerate().map(|(place, ((shape, plan), id))| {
                let (shape, stride) = shape;
                let data = match (start(place), plan) {
                    (Some(start), _) => start.cast_const(),
                    (None, StreamPlan::Shared(stream)) => stream.data().as_ptr(),
                    (None, StreamPlan::New(_)) => ptr::null(),
                };
                ptl_stream {
                    struct_size: count(size_of::<ptl_stream>()),
                    r#type: shape.scalar as u32,
                    components: shape.components,
                    flags: if shape.is_constant { PTL_STREAM_CONSTANT } else { 0 },
                    id: id.as_ptr(),
                    data: data.cast(),
                    stride,
                }
            });
        let streams: Box<[ptl_stream]> = streams.collect();
        let pointers = streams.iter().map(ptr::from_ref).collect();
        Self { pointers, _streams: streams, _ids: ids }
    }
}

/// The table of the service.
pub(super) static VALUES: ptlp_values = ptlp_values {
    struct_size: count(size_of::<ptlp_values>()),
    reserved0: 0,
    mesh_begin: Some(mesh_begin),
    points_begin: Some(points_begin),
    strands_begin: Some(strands_begin),
    finish: Some(finish),
    text: Some(text),
    gradient: Some(gradient),
    pass: Some(pass),
};

/// Runs a function of the service; its error is noted in the call.
///
/// # Safety
/// The contract.
unsafe fn serve(
    job: *const ptlp_job,
    run: impl FnOnce(&Call<'_>, &Making<'_>) -> Result<(), Error>,
) -> ptlp_status {
    // SAFETY: the contract.
    let Some(call) = (unsafe { call_of(job) }) else { return PTLP_E_INVALID_ARGUMENT };
    guarded(PTLP_E_FAILED, || {
        let done = match call.means.making {
            Some(making) => run(call, making),
            None => Err(Error::new(
                ErrorKind::Unsupported,
                "values are made in `compute` of the shape WHOLE",
            )),
        };
        done.map_or_else(|error| call.fail(error), |()| PTLP_OK)
    })
}

unsafe extern "C" fn mesh_begin(
    job: *const ptlp_job,
    output: u32,
    mesh: *mut ptl_mesh_data,
) -> ptlp_status {
    // SAFETY: the contract, in all of it.
    unsafe {
        serve(job, |call, making| {
            let mut data = read(mesh.cast_const(), "mesh")?;
            zero(data.flags, "mesh.flags")?;
            let limits = call.means.limits;
            let plans = making.plans(data.streams, data.stream_count, limits)?;
            let indices = making.numbers(data.indices, data.index_count, "mesh.indices")?;
            let draft =
                Draft::mesh(data.vertex_count, indices, plans.clone(), (limits, making.pool))?;
            let (numbers, [streams, _]) = making.begin(output, draft, [plans, vec![]])?;
            if data.indices.is_null() {
                data.indices = numbers;
            }
            data.streams = streams;
            mesh.write(data);
            Ok(())
        })
    }
}

unsafe extern "C" fn points_begin(
    job: *const ptlp_job,
    output: u32,
    points: *mut ptl_points_data,
) -> ptlp_status {
    // SAFETY: the contract, in all of it.
    unsafe {
        serve(job, |call, making| {
            let mut data = read(points.cast_const(), "points")?;
            zero(data.flags, "points.flags")?;
            let limits = call.means.limits;
            let plans = making.plans(data.streams, data.stream_count, limits)?;
            let draft = Draft::points(data.point_count, plans.clone(), (limits, making.pool))?;
            let (_, [streams, _]) = making.begin(output, draft, [plans, vec![]])?;
            data.streams = streams;
            points.write(data);
            Ok(())
        })
    }
}

unsafe extern "C" fn strands_begin(
    job: *const ptlp_job,
    output: u32,
    strands: *mut ptl_strands_data,
) -> ptlp_status {
    // SAFETY: the contract, in all of it.
    unsafe {
        serve(job, |call, making| {
            let mut data = read(strands.cast_const(), "strands")?;
            zero(data.flags, "strands.flags")?;
            let limits = call.means.limits;
            let entries = data.strand_count.checked_add(1).ok_or_else(|| {
                Error::new(ErrorKind::Limit, "so many strands are more than are allowed")
            })?;
            let first_point = making.numbers(data.first_point, entries, "strands.first_point")?;
            let (of_points, of_strands) = (data.point_streams, data.strand_streams);
            let plans = [
                making.plans(of_points, data.point_stream_count, limits)?,
                making.plans(of_strands, data.strand_stream_count, limits)?,
            ];
            let [points, strand] = plans.clone();
            let memory = (limits, making.pool);
            let draft = Draft::strands(data.point_count, first_point, points, strand, memory)?;
            let (numbers, [of_points, of_strands]) = making.begin(output, draft, plans)?;
            if data.first_point.is_null() {
                data.first_point = numbers;
            }
            (data.point_streams, data.strand_streams) = (of_points, of_strands);
            strands.write(data);
            Ok(())
        })
    }
}

unsafe extern "C" fn finish(job: *const ptlp_job, output: u32) -> ptlp_status {
    // SAFETY: the contract.
    unsafe { serve(job, |call, making| making.finish(output, call.means.limits)) }
}

unsafe extern "C" fn text(
    job: *const ptlp_job,
    output: u32,
    utf8: *const c_char,
    size: usize,
) -> ptlp_status {
    let data = ptl_text_data {
        struct_size: count(size_of::<ptl_text_data>()),
        flags: 0,
        text: utf8,
        size,
    };
    // SAFETY: the contract, in all of it.
    unsafe {
        serve(job, |call, making| {
            let text = Import::copying(call.means.limits).text(&raw const data)?;
            making.put(output, Output::Made(text.into()), Kind::Text)
        })
    }
}

unsafe extern "C" fn gradient(
    job: *const ptlp_job,
    output: u32,
    stops: *const ptl_gradient_stop,
    stop_count: u32,
) -> ptlp_status {
    let data =
        ptl_gradient_data { struct_size: count(size_of::<ptl_gradient_data>()), stop_count, stops };
    // SAFETY: the contract, in all of it.
    unsafe {
        serve(job, |call, making| {
            let gradient = Import::copying(call.means.limits).gradient(&raw const data)?;
            making.put(output, Output::Made(gradient.into()), Kind::Gradient)
        })
    }
}

unsafe extern "C" fn pass(job: *const ptlp_job, output: u32, input: u32) -> ptlp_status {
    // SAFETY: the contract.
    unsafe {
        serve(job, |_, making| {
            let value = making.inputs.get(input as usize).and_then(Option::as_ref);
            let message = || wrong(format!("there is nothing at input {input}"));
            let value = value.ok_or_else(message)?.clone();
            let kind = value.kind();
            if kind == Kind::Image {
                return Err(wrong("images are written, not passed"));
            }
            making.put(output, Output::Made(value), kind)
        })
    }
}
