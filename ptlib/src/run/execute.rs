//! Carrying out a plan, stage after stage.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc, Mutex, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
};

use super::{
    cache::Cache,
    log::{Log, LogLevel},
    monitor::Monitor,
    nodes::{Node, Work},
    plan::{Plan, Stage},
    rows::{self, Member, RowSource, StageRows},
    sink::Sink,
};
use crate::{
    block::{Access, Context, Files, PlaneCounts, Progress, RowKernel, Store},
    error::{Error, ErrorKind},
    limits::Limits,
    math::{levels::Precision, simd::SimdLevel},
    value::{BufferPool, Image, Kind, Value},
};

/// What a computation uses and shares.
pub(super) struct Means<'a> {
    pub(super) precision: Precision,
    pub(super) simd: SimdLevel,
    pub(super) pool: &'a Arc<BufferPool>,
    pub(super) files: &'a dyn Files,
    pub(super) cache: &'a Cache,
    pub(super) monitor: &'a Monitor<'a>,
    pub(super) limits: &'a Limits,
    /// The most bytes that the computation may take at its peak.
    pub(super) memory_bytes: u64,
    pub(super) log: &'a Log,
    pub(super) keep_going: bool,
    /// Rows of a task; 0 to choose.
    pub(super) strip_rows: u32,
}

impl Means<'_> {
    /// Logs a fault that a white image stands for.
    fn tell_white(&self, fault: &Error) {
        self.log.tell(LogLevel::Warning, &format!("went on with white: {fault}"));
    }
}

/// The inputs of a node.
struct Inputs {
    /// The stored values.
    values: Vec<Option<Value>>,
    /// For each input, whether there is a value or a row at a time.
    connected: Vec<bool>,
    /// For each input, the planes of its image.
    planes: Vec<usize>,
    /// For each output, the planes of its image.
    output_planes: Vec<usize>,
}

/// The values of all nodes while a plan is carried out, and what went wrong on the way.
pub(super) struct Execution<'a, 'g> {
    plan: &'a Plan<'g>,
    means: &'a Means<'a>,
    /// Per node and output.
    values: Vec<Vec<Option<Value>>>,
    /// Per node, the bytes of its values that are no images: the plan could not know them.
    unplanned: Vec<u64>,
    /// Faults that a white image stands for.
    pub(super) failures: Vec<Error>,
}

impl<'a, 'g> Execution<'a, 'g> {
    pub(super) fn new(plan: &'a Plan<'g>, means: &'a Means<'a>, failures: Vec<Error>) -> Self {
        let values = plan.nodes.iter().map(|node| match &node.work {
            Work::Kept(values) => values.iter().cloned().map(Some).collect(),
            _ => vec![None; node.outputs.len()],
        });
        let values = values.collect();
        let unplanned = vec![0; plan.nodes.len()];
        for failure in &failures {
            means.tell_white(failure);
        }
        Self { plan, means, values, unplanned, failures }
    }

    /// Computes everything; `sinks` has one sink for each wanted output of the plan.
    pub(super) fn run(&mut self, sinks: &mut [Sink<'_>]) -> Result<(), Error> {
        for (number, stage) in (0..).zip(&self.plan.stages) {
            let root = &self.plan.nodes[stage.root];
            self.means.monitor.start_stage(number, root.id, stage.units);
            self.means.monitor.check()?;
            match &root.work {
                Work::Whole(_) if !stage.members.is_empty() => self.compute_whole(stage)?,
                Work::White if root.outputs.iter().any(|output| output.kind != Kind::Image) => {
                    self.values[stage.root] = self.white(root)?;
                    self.means.monitor.add_units(stage.units);
                }
                _ => self.compute_rows(stage, sinks)?,
            }
            self.keep(stage);
            for node in &stage.freed {
                self.values[*node].fill(None);
                self.unplanned[*node] = 0;
            }
        }
        self.means.monitor.finish()
    }

    /// The stored value of an output.
    pub(super) fn value(&self, node: usize, output: usize) -> Option<&Value> {
        self.values[node][output].as_ref()
    }

    /// Puts what a stage stored into the cache. Results that white images stand in are not what
    /// their keys say.
    fn keep(&self, stage: &Stage) {
        if stage.members.is_empty() || !self.means.cache.is_on() || !self.failures.is_empty() {
            return;
        }
        let key = &self.plan.nodes[stage.root].key;
        for (output, value) in self.values[stage.root].iter().enumerate() {
            // Somebody waits to get back what is borrowed.
            if let Some(value) = value.as_ref().filter(|value| !value.is_borrowed()) {
                self.means.cache.put(key.of_output(output, 1), value);
            }
        }
    }

    fn context<'b>(
        &'b self,
        node: &Node<'b>,
        inputs: &'b Inputs,
        tell: &'b (dyn Fn(LogLevel, Error) + Sync),
    ) -> Context<'b> {
        let (width, height) = self.plan.sizes.working();
        Context {
            width,
            height,
            seed: node.seed,
            simd: self.means.simd,
            inputs: &inputs.values,
            connected: &inputs.connected,
            given: node.given.map(|given| &given.value),
            pool: self.means.pool,
            files: self.means.files,
            progress: self.means.monitor,
            limits: self.means.limits,
            planes: PlaneCounts { inputs: &inputs.planes, outputs: &inputs.output_planes },
            tell,
        }
    }

    fn inputs(&self, node: &Node<'_>) -> Inputs {
        let value = |link: &super::nodes::Link| self.values[link.node][link.output].clone();
        let values: Vec<_> = node.inputs.iter().map(|link| link.as_ref().and_then(value)).collect();
        let comes_in_rows = |port| node.access(port) == Access::SameRow;
        let connected = node.inputs.iter().zip(&values).enumerate().map(|(port, (link, value))| {
            value.is_some() || (link.is_some() && comes_in_rows(port))
        });
        let planes = |link: &Option<super::nodes::Link>| {
            link.map_or(0, |link| self.plan.nodes[link.node].outputs[link.output].planes)
        };
        Inputs {
            connected: connected.collect(),
            planes: node.inputs.iter().map(planes).collect(),
            output_planes: node.outputs.iter().map(|output| output.planes).collect(),
            values,
        }
    }

    fn compute_whole(&mut self, stage: &Stage) -> Result<(), Error> {
        let node = &self.plan.nodes[stage.root];
        let Work::Whole(factory) = node.work else { return Ok(()) };
        let inputs = self.inputs(node);
        let tell = |level, what| self.tell(node, level, what);
        let cx = self.context(node, &inputs, &tell);
        let computed = guard(|| factory.compute(node.block.values(), self.means.precision, &cx));
        drop(inputs);
        let counted = computed.and_then(|values| self.count(stage.root, values));
        match counted.and_then(|values| self.check_outputs(node, values)) {
            Ok((values, strange)) => {
                self.values[stage.root] = values.into_iter().map(Some).collect();
                self.tell_strange(node, strange);
            }
            Err(error) => {
                self.fail(node, error)?;
                self.values[stage.root] = self.white(node)?;
            }
        }
        self.means.monitor.add_units(stage.units);
        Ok(())
    }

    /// Counts the memory of values that are no images. What the caller gave is the caller's.
    fn count(&mut self, node: usize, values: Vec<Value>) -> Result<Vec<Value>, Error> {
        let others = values.iter().filter(|value| value.kind() != Kind::Image);
        let bytes: u64 = others.map(Value::bytes).sum();
        if bytes == 0 || self.plan.nodes[node].given.is_some() {
            return Ok(values);
        }
        self.unplanned[node] = bytes;
        let all = self.unplanned.iter().fold(self.plan.peak_bytes, |sum, b| sum.saturating_add(*b));
        let (limit, mebibyte) = (self.means.memory_bytes, 1 << 20);
        if all <= limit {
            return Ok(values);
        }
        self.unplanned[node] = 0;
        let message = format!(
            "gives values of {} MiB; with all others that makes {} MiB, allowed {} MiB",
            bytes.div_ceil(mebibyte),
            all.div_ceil(mebibyte),
            limit / mebibyte
        );
        Err(Error::new(ErrorKind::Limit, message))
    }

    /// Notes a failure, or ends the computation with it.
    fn fail(&mut self, node: &Node<'_>, error: Error) -> Result<(), Error> {
        let error = node.at(error);
        if !self.means.keep_going || error.kind() == ErrorKind::Cancelled {
            return Err(error);
        }
        self.means.tell_white(&error);
        self.failures.push(error);
        Ok(())
    }

    /// Logs that a block gave numbers that are not finite.
    fn tell_strange(&self, node: &Node<'_>, count: u64) {
        if count > 0 {
            let message = format!("gave {count} numbers that are not finite; they became 0");
            self.tell(node, LogLevel::Error, Error::new(ErrorKind::Internal, message));
        }
    }

    /// Logs what somebody should know of a block.
    fn tell(&self, node: &Node<'_>, level: LogLevel, what: Error) {
        self.means.log.tell(level, &node.at(what).to_string());
    }

    /// White images and empty texts in place of the outputs of a block that failed (specification
    /// 4.3).
    fn white(&self, node: &Node<'_>) -> Result<Vec<Option<Value>>, Error> {
        let (width, height) = self.plan.sizes.working();
        let outputs = node.outputs.iter().map(|output| {
            match output.kind {
                Kind::Image => {}
                Kind::Text => return Ok(Some(Value::Text("".into()))),
                Kind::Gradient | Kind::Points | Kind::Mesh | Kind::Strands => return Ok(None),
            }
            let mut image = Image::new(self.means.pool, width, height, output.planes)?;
            image.planes_mut().for_each(|plane| plane.fill(1.0));
            Ok(Some(Value::Image(image)))
        });
        outputs.collect()
    }

    /// What a block of shape Whole gave, stored as its outputs say.
    fn check_outputs(
        &self,
        node: &Node<'_>,
        values: Vec<Value>,
    ) -> Result<(Vec<Value>, u64), Error> {
        let broken = |what: String| Err(Error::new(ErrorKind::Internal, what));
        if values.len() != node.outputs.len() {
            return broken(format!("gave {} of {} outputs", values.len(), node.outputs.len()));
        }
        let (width, height) = self.plan.sizes.working();
        let strange = AtomicU64::new(0);
        let mut stored = Vec::with_capacity(values.len());
        for (value, output) in values.into_iter().zip(&node.outputs) {
            if value.kind() != output.kind {
                return broken(format!(
                    "gave a value of kind {} for one of kind {}",
                    value.kind().name(),
                    output.kind.name()
                ));
            }
            let Value::Image(image) = value else {
                stored.push(value);
                continue;
            };
            if (image.width(), image.height()) != (width, height) || image.planes() != output.planes
            {
                return broken(format!(
                    "gave {} planes of {} × {} for {} of {width} × {height}",
                    image.planes(),
                    image.width(),
                    image.height(),
                    output.planes
                ));
            }
            let store = Store::of(self.means.precision, output.is_free);
            let image = image.map_planes(self.means.pool, |plane| {
                let progress: &dyn Progress = self.means.monitor;
                let pieces: Vec<_> = plane.chunks_mut(1 << 16).map(Mutex::new).collect();
                progress.parallel(pieces.len(), &|i| {
                    let mut piece = pieces[i].lock().unwrap_or_else(PoisonError::into_inner);
                    let count = store.apply(self.means.simd, &mut piece);
                    strange.fetch_add(u64::from(count), Ordering::Relaxed);
                    Ok(())
                })
            })?;
            stored.push(Value::Image(image));
        }
        Ok((stored, strange.into_inner()))
    }

    fn compute_rows(&mut self, stage: &Stage, sinks: &mut [Sink<'_>]) -> Result<(), Error> {
        let mut members = Vec::with_capacity(stage.members.len());
        for &number in &stage.members {
            let member = self.prepare(number, stage)?;
            members.push(member);
        }
        let root = &self.plan.nodes[stage.root];
        let (width, height) = self.plan.sizes.working();
        let is_stored = root.is_stored && !members.is_empty();
        let mut stored = Vec::new();
        if is_stored {
            for output in &root.outputs {
                stored.push(Image::new(self.means.pool, width, height, output.planes)?);
            }
        }
        let strange = loop {
            let done = self.stage_rows(stage, &members).run(self.means, &mut stored, sinks);
            match done {
                Ok(strange) => break strange,
                Err((Some(member), error)) => {
                    // With a white image in its place, all rows are made anew.
                    self.fail(&self.plan.nodes[stage.members[member]], error)?;
                    members[member].kernel = Box::new(White);
                }
                Err((None, error)) => return Err(error),
            }
        };
        // A row may have been left half written because of a request that came after the last
        // check.
        self.means.monitor.check()?;
        for (member, (number, count)) in members.iter().zip(stage.members.iter().zip(strange)) {
            let node = &self.plan.nodes[*number];
            for (level, what) in member.kernel.messages() {
                self.tell(node, level, what);
            }
            self.tell_strange(node, count);
        }
        if is_stored {
            self.values[stage.root] =
                stored.into_iter().map(|image| Some(Value::Image(image))).collect();
        }
        Ok(())
    }

    /// A stage, ready to run.
    fn stage_rows<'b>(&'b self, stage: &Stage, members: &'b [Member]) -> StageRows<'b> {
        let root = &self.plan.nodes[stage.root];
        StageRows {
            members,
            sets: rows::BufferSets::new(members),
            given: match (members.is_empty(), stage.handed_over.first()) {
                (true, Some(place)) => self.value(stage.root, self.plan.wanted[*place].output),
                _ => None,
            },
            handed_over: stage
                .handed_over
                .iter()
                .map(|place| rows::Handed {
                    place: *place,
                    first_plane: root.first_plane(self.plan.wanted[*place].output),
                    planes: root.outputs[self.plan.wanted[*place].output].planes,
                })
                .collect(),
            sizes: self.plan.sizes,
            units: stage.units,
        }
    }

    /// Prepares a node for the stage that it is fused into.
    fn prepare(&mut self, number: usize, stage: &Stage) -> Result<Member, Error> {
        let node = &self.plan.nodes[number];
        let kernel = self.kernel(node);
        let kernel = match kernel {
            Ok(kernel) => kernel,
            Err(error) => {
                self.fail(node, error)?;
                Box::new(White)
            }
        };
        let sources = node.inputs.iter().enumerate().map(|(port, link)| {
            let Some(link) = link else { return RowSource::None };
            if node.access(port) == Access::Anywhere {
                return RowSource::None;
            }
            match stage.members.iter().position(|member| *member == link.node) {
                Some(member) => RowSource::Member {
                    member,
                    first_plane: self.plan.nodes[link.node].first_plane(link.output),
                    planes: self.plan.nodes[link.node].outputs[link.output].planes,
                },
                None => match self.value(link.node, link.output) {
                    Some(Value::Image(image)) => RowSource::Image(image.clone()),
                    _ => RowSource::None,
                },
            }
        });
        let stores = node.outputs.iter().flat_map(|output| {
            let store = Store::of(self.means.precision, output.is_free);
            std::iter::repeat_n(store, output.planes)
        });
        Ok(Member {
            kernel,
            sources: sources.collect(),
            stores: stores.collect(),
            needs_whole_rows: node.reads_anywhere(),
        })
    }

    fn kernel(&self, node: &Node<'_>) -> Result<Box<dyn RowKernel>, Error> {
        match node.work {
            Work::Rows(factory) => {
                let inputs = self.inputs(node);
                let tell = |level, what| self.tell(node, level, what);
                let cx = self.context(node, &inputs, &tell);
                guard(|| factory.prepare(node.block.values(), self.means.precision, &cx))
            }
            _ => Ok(Box::new(White)),
        }
    }
}

/// Runs code of a block; a panic in it becomes an error.
pub(super) fn guard<T>(run: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
    catch_unwind(AssertUnwindSafe(run)).unwrap_or_else(|payload| {
        let text = payload
            .downcast_ref::<&str>()
            .copied()
            .or_else(|| payload.downcast_ref::<String>().map(String::as_str))
            .unwrap_or("no message");
        let message = format!("the block has a defect and panicked: {text}");
        Err(Error::new(ErrorKind::Internal, message))
    })
}

/// Stands for a block that failed.
struct White;

impl RowKernel for White {
    fn row(
        &self,
        _: &crate::block::RowContext<'_>,
        _: &crate::block::InputRows<'_>,
        out: &mut crate::block::OutputRow<'_>,
    ) -> Result<(), Error> {
        out.iter_mut().for_each(|plane| plane.fill(1.0));
        Ok(())
    }
}
