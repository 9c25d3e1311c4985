//! `ptc render`: graphs into pictures.
//!
//! First everything is planned: every graph is read, and the name of every picture is known. Only
//! then is anything computed, so that a batch whose pictures would overwrite each other is refused
//! before it has cost time. A graph that fails does not keep the others from being rendered.

mod arguments;
mod batch;
mod plan;

pub(crate) use arguments::RenderArguments;

use ptlib::Engine;

use crate::{
    exit::{Exit, Fault},
    interrupt,
};

/// Runs the command.
pub(crate) fn run(arguments: &RenderArguments) -> Result<Exit, Fault> {
    let cancel = interrupt::cancel_on_interrupt();
    let engine = Engine::new(arguments.engine_options());
    let plugins = arguments.plugins.load(&engine, !arguments.quiet)?;
    let plan = plan::plan(arguments, &engine, plugins)?;
    Ok(batch::render(arguments, &engine, &plan, &cancel))
}
