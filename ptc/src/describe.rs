//! `ptc describe`: one block type.

use std::io::{self, Write};

use serde_json::Value;

use crate::{
    description::{
        BlockDescription, InputDescription, OutputDescription, ParameterDescription,
        RangeDescription,
    },
    exit::{Exit, Fault},
    plugins::{PluginOptions, engine_for_types},
    terminal::{self, Printable, wrap},
};

/// The command's arguments.
#[derive(Debug, clap::Args)]
pub(crate) struct DescribeArguments {
    /// The id of the block type; words need no quotes: ptc describe perlin noise
    #[arg(required = true)]
    block: Vec<String>,

    /// Print the description as JSON
    #[arg(long)]
    json: bool,

    #[command(flatten)]
    plugins: PluginOptions,
}

/// Runs the command.
pub(crate) fn run(arguments: &DescribeArguments) -> Result<Exit, Fault> {
    let engine = engine_for_types();
    let mut plugins = arguments.plugins.load(&engine, true)?;
    let id = arguments.block.join(" ");
    let spec = plugins.block_type(&id).map_err(|error| {
        Fault::usage(error.message(), error.hint().unwrap_or("`ptc list` shows all"))
    })?;
    let block = BlockDescription::of(engine.registry(), spec);
    let mut out = terminal::stdout();
    if arguments.json {
        terminal::write_json(&mut out, &block)?;
    } else {
        Page { out: &mut out, columns: terminal::columns() }.print(&block)?;
    }
    Ok(Exit::Success)
}

/// A page of text of so many columns.
struct Page<W> {
    out: W,
    columns: usize,
}

impl<W: Write> Page<W> {
    fn print(&mut self, block: &BlockDescription) -> io::Result<()> {
        let heading = terminal::heading();
        writeln!(self.out, "{heading}{}{heading:#} ({})", block.id, block.family)?;
        self.paragraphs(block.summary, 2)?;
        self.ports(block)?;
        if !block.parameters.is_empty() {
            self.heading("Parameters")?;
            for parameter in &block.parameters {
                self.parameter(parameter)?;
            }
        }
        self.heading("Notes")?;
        for note in notes(block) {
            self.paragraphs(&note, 2)?;
        }
        Ok(())
    }

    fn ports(&mut self, block: &BlockDescription) -> io::Result<()> {
        if !block.inputs.is_empty() {
            self.heading("Inputs")?;
        }
        for (slot, input) in block.inputs.iter().enumerate() {
            self.entry(2, &format!("{slot} {}", input.id), &about_input(input))?;
        }
        if !block.outputs.is_empty() {
            self.heading("Outputs")?;
        }
        for (slot, output) in block.outputs.iter().enumerate() {
            self.entry(2, &format!("{slot} {}", output.id), &about_output(output))?;
        }
        Ok(())
    }

    fn parameter(&mut self, parameter: &ParameterDescription) -> io::Result<()> {
        self.entry(2, parameter.id, &about_parameter(parameter))?;
        self.paragraphs(&parameter.doc, 6)?;
        for choice in &parameter.choices {
            self.entry(8, &format!("{} {}", choice.number, choice.id), &choice.doc)?;
        }
        Ok(())
    }

    fn heading(&mut self, text: &str) -> io::Result<()> {
        let heading = terminal::heading();
        writeln!(self.out, "\n{heading}{text}{heading:#}")
    }

    /// A name and what is to be said of it; further lines are indented below it.
    fn entry(&mut self, indent: usize, name: &str, text: &str) -> io::Result<()> {
        let heading = terminal::heading();
        let hanging = indent + 2;
        let lines = wrap(&format!("{name}: {text}"), self.columns.saturating_sub(hanging));
        for (number, line) in lines.iter().enumerate() {
            match line.strip_prefix(name) {
                Some(rest) if number == 0 => {
                    writeln!(self.out, "{:indent$}{heading}{name}{heading:#}{rest}", "")?;
                }
                _ => writeln!(self.out, "{:hanging$}{line}", "")?,
            }
        }
        Ok(())
    }

    fn paragraphs(&mut self, text: &str, indent: usize) -> io::Result<()> {
        for paragraph in text.split("\n\n") {
            for line in wrap(paragraph, self.columns.saturating_sub(indent)) {
                writeln!(self.out, "{:indent$}{line}", "")?;
            }
        }
        Ok(())
    }
}

fn about_input(input: &InputDescription) -> String {
    let need = if input.is_optional { "optional" } else { "required" };
    format!("{}, {need}", input.kind)
}

fn about_output(output: &OutputDescription) -> String {
    let mut text = output.kind.to_owned();
    match output.planes {
        Some("as inputs") => {
            let inputs: Vec<_> = output.planes_of.iter().map(|id| format!("\"{id}\"")).collect();
            text.push_str(&format!(", grey or coloured as {}", inputs.join(" and ")));
        }
        Some("by parameters") => text.push_str(", grey or coloured by its parameters"),
        Some(planes) => text.extend([", ", planes]),
        None => {}
    }
    match output.range {
        Some("free") => text.push_str(", any finite values"),
        Some(_) => text.push_str(", values 0 to 1"),
        None => {}
    }
    text
}

fn about_parameter(parameter: &ParameterDescription) -> String {
    let mut text = parameter.kind.to_owned();
    if let (Some(hard), Some(soft)) = (&parameter.hard, &parameter.soft) {
        text.extend([", ", &span(hard)]);
        if !parameter.unit.is_empty() {
            text.extend([" ", parameter.unit]);
        }
        if hard != soft {
            text.extend([", usually ", &span(soft)]);
        }
    }
    match parameter.file_use {
        Some("read") => text.push_str(" of a file to read"),
        Some(_) => text.push_str(" of a file to write"),
        None => {}
    }
    text.extend([", default ", &default(parameter)]);
    text
}

fn default(parameter: &ParameterDescription) -> String {
    let chosen = parameter.choices.iter().find(|choice| parameter.default == choice.number);
    match (&parameter.default, chosen) {
        (_, Some(choice)) => format!("{} ({})", choice.number, choice.id),
        (Value::String(text), _) if text.is_empty() => "empty".to_owned(),
        (value, _) => number(value),
    }
}

/// `1..=10`; an end that only says how large a number can be is left out.
fn span(range: &RangeDescription) -> String {
    let is_end = |value: &Value| value.as_f64().is_some_and(|value| value.abs() < 1e9);
    match (is_end(&range.min), is_end(&range.max)) {
        (true, true) => format!("{}..={}", number(&range.min), number(&range.max)),
        (true, false) => format!("from {} on", number(&range.min)),
        (false, true) => format!("up to {}", number(&range.max)),
        (false, false) => "any".to_owned(),
    }
}

/// A value as people write it: `1`, not `1.0`.
fn number(value: &Value) -> String {
    match value.as_f64() {
        Some(number) => number.to_string(),
        None => value.to_string(),
    }
}

/// What else is worth knowing, in sentences.
fn notes(block: &BlockDescription) -> Vec<String> {
    let mut notes = vec![];
    match block.role {
        "result" => notes.push("Its output is a result of the graph.".to_owned()),
        "input" => {
            notes.push("The caller sets its value, as with `ptc render --input`.".to_owned());
        }
        "writer" => notes.push("It writes a file, where `--allow-write` lets it.".to_owned()),
        _ => {}
    }
    match &block.tiling_exception {
        Some(exception) => notes.push(format!("Tiling: {exception}")),
        None => notes.push("Tiling: its output tiles when its inputs do.".to_owned()),
    }
    if !block.in_pixels.is_empty() {
        notes.push(format!(
            "In pixels, so that the picture depends on its size: {}",
            block.in_pixels
        ));
    }
    if block.uses_seed {
        notes.push("Seed: another one gives another picture.".to_owned());
    }
    if let Some(since) = &block.since {
        notes.push(format!("Since version {since}."));
    }
    if let Some(plugin) = &block.plugin {
        notes.push(format!("From a plug-in: {}.", Printable(&plugin.in_words())));
        notes.extend(plugin.file.as_ref().map(|file| format!("Its file: {}", Printable(file))));
    }
    notes
}

#[cfg(test)]
mod tests {
    use ptlib::block::Registry;

    use super::*;

    fn page(columns: usize, id: &str) -> String {
        let registry = Registry::builtin();
        let block = BlockDescription::of(&registry, registry.find(id).unwrap());
        let mut out = Vec::new();
        Page { out: &mut out, columns }.print(&block).unwrap();
        String::from_utf8(anstream::adapter::strip_bytes(&out).into_vec()).unwrap()
    }

    #[test]
    fn pages_fit_their_columns_and_name_everything() {
        for spec in Registry::builtin().blocks() {
            for columns in [40, 80] {
                let page = page(columns, spec.about.id);
                let widest = page.lines().map(|line| line.chars().count()).max();
                assert!(widest <= Some(columns), "{page}");
                for id in spec.params.iter().map(|parameter| parameter.id) {
                    assert!(page.contains(&format!("\n  {id}:")), "{id} in {page}");
                }
            }
        }
    }

    #[test]
    fn ranges_read_as_people_write_them() {
        let span = |min: Value, max: Value| span(&RangeDescription { min, max });
        assert_eq!(span(1.into(), 10.into()), "1..=10");
        assert_eq!(span(0.0.into(), 0.5.into()), "0..=0.5");
        assert_eq!(span(0.into(), i32::MAX.into()), "from 0 on");
        assert_eq!(span(f64::MIN.into(), 3.0.into()), "up to 3");
        assert_eq!(span(i32::MIN.into(), i32::MAX.into()), "any");
    }
}
