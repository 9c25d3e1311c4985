//! `ptc list`: the block types.

use std::io::{self, Write};

use ptlib::block::Registry;
use serde::Serialize;

use crate::{
    description::BlockDescription,
    exit::{Exit, Fault},
    plugins::{PluginOptions, engine_for_types},
    terminal::{self, wrap},
};

/// The command's arguments.
#[derive(Debug, clap::Args)]
pub(crate) struct ListArguments {
    /// Only the block types of this family
    #[arg(long, value_name = "F")]
    family: Option<String>,

    /// Print everything that is known of them as JSON: {"blocks": [...]}, each as `ptc describe
    /// --json` prints it
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    plugins: PluginOptions,
}

#[derive(Serialize)]
struct Catalogue {
    blocks: Vec<BlockDescription>,
}

/// Runs the command.
pub(crate) fn run(arguments: &ListArguments) -> Result<Exit, Fault> {
    let engine = engine_for_types();
    arguments.plugins.load(&engine, true)?.load_usual();
    let mut blocks = described(engine.registry());
    if let Some(family) = &arguments.family {
        let families = families(&blocks);
        blocks.retain(|block| block.family == family);
        if blocks.is_empty() {
            let message = format!("there is no family \"{family}\"");
            return Err(Fault::usage(message, format!("families are {families}")));
        }
    }
    let mut out = terminal::stdout();
    if arguments.json {
        terminal::write_json(&mut out, &Catalogue { blocks })?;
    } else {
        print(&mut out, &blocks, terminal::columns())?;
    }
    Ok(Exit::Success)
}

fn described(registry: &Registry) -> Vec<BlockDescription> {
    let blocks = registry.blocks().into_iter();
    blocks.map(|spec| BlockDescription::of(registry, spec)).collect()
}

fn families(blocks: &[BlockDescription]) -> String {
    let mut families = vec![];
    for block in blocks {
        if !families.contains(&block.family) {
            families.push(block.family);
        }
    }
    families.join(", ")
}

/// Prints one heading a family of each plug-in, and below it one line a block type, or more if the
/// summary is long.
fn print(out: &mut impl Write, blocks: &[BlockDescription], columns: usize) -> io::Result<()> {
    let heading = terminal::heading();
    let widest = blocks.iter().map(|block| block.id.chars().count()).max().unwrap_or_default();
    let indent = widest + 4;
    let mut before: Option<&BlockDescription> = None;
    for block in blocks {
        let family = block.family;
        if before.is_none_or(|before| before.family != family || before.plugin != block.plugin) {
            if before.is_some() {
                writeln!(out)?;
            }
            write!(out, "{heading}{family}{heading:#}")?;
            match &block.plugin {
                Some(plugin) => writeln!(out, " (plug-in {} {})", plugin.id, plugin.version)?,
                None => writeln!(out)?,
            }
        }
        before = Some(block);
        let lines = wrap(block.summary, columns.saturating_sub(indent));
        let summary = lines.join(&format!("\n{:indent$}", ""));
        writeln!(out, "  {:widest$}  {summary}", block.id)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_catalogue_fits_its_columns() {
        let blocks = described(&Registry::builtin());
        for columns in [50, 80] {
            let mut out = Vec::new();
            print(&mut out, &blocks, columns).unwrap();
            let text = anstream::adapter::strip_bytes(&out).into_vec();
            let text = String::from_utf8(text).unwrap();
            assert!(text.lines().all(|line| line.chars().count() <= columns), "{text}");
            assert!(blocks.iter().all(|block| text.contains(&format!("\n  {} ", block.id))));
        }
    }
}
