//! The page of a block.

use super::{
    essay, has_pictures,
    markdown::{NOTICE, code, escaped, number, table},
    pictures,
    registry::{Block, Parameter, ParameterKind, Range, value_in_files},
    settings::{Setting, changes, settings},
};

/// The page. Its parts are separated by blank lines.
pub(super) fn page(block: &Block, essay: &str) -> String {
    let mut parts =
        vec![format!("{NOTICE}\n# {}", block.id), escaped(&block.summary), facts(block)];
    if has_pictures(block) {
        parts.push(gallery(block));
    }
    parts.extend([inputs(block), outputs(block), parameters(block)]);
    parts.push(format!("## In a graph file\n\n```xml\n{}\n```", sample(block)));
    let mut source = format!("Source: `{}`.", essay::source(block));
    if essay.contains("pecification") {
        source.push_str(" What the specification is, [the list of blocks](index.md) tells.");
    }
    parts.push(format!("## How it works\n\n{essay}\n\n{source}"));
    parts.retain(|part| !part.is_empty());
    parts.iter().map(|part| part.trim_end()).collect::<Vec<_>>().join("\n\n") + "\n"
}

/// What holds for the block as a whole.
fn facts(block: &Block) -> String {
    let mut facts = vec![format!("Family *{}*, since version {}.", block.family, block.since)];
    if !block.outputs.is_empty() {
        facts.push(tiling(block));
    }
    if let Some(lengths) = &block.in_pixels {
        let link = "[so the picture depends on the resolution](../src/units.md)";
        facts.push(format!("Counts pixels, {link}: {}.", escaped(lengths)));
    }
    if block.uses_seed {
        facts.push("Another seed gives another picture.".to_owned());
    }
    facts.iter().map(|fact| format!("- {fact}\n")).collect()
}

/// Whether the output tiles.
pub(super) fn tiling(block: &Block) -> String {
    let when = if block.inputs.iter().any(|input| input.kind == "image") {
        "Tiles if its inputs do"
    } else {
        "Tiles"
    };
    match &block.tiling_exception {
        Some(exception) => format!("{when}, with an exception: {}.", escaped(exception)),
        None if block.tiles => format!("{when}."),
        None => "Does not tile.".to_owned(),
    }
}

/// The pictures and what they show.
fn gallery(block: &Block) -> String {
    let settings = settings(block);
    let row = |cell: fn(&Block, Setting) -> String| {
        let cells = settings.iter().map(|&setting| format!(" {} |", cell(block, setting)));
        format!("|{}\n", cells.collect::<String>())
    };
    let titles = row(|_, setting| title(setting).to_owned());
    let pictures = row(|block, setting| {
        let (title, name) = (title(setting), pictures::name(block, setting));
        format!("![{}, {title}](pictures/{name})", block.id)
    });
    let lines = "---|".repeat(settings.len());
    let captions = if settings.len() > 1 { row(caption) } else { String::new() };
    let given = block.examples.source.as_ref().map_or_else(String::new, |(given, _)| {
        format!("\nHere, the input at slot 0 is [{given}]({}.md).\n", given.replace(' ', "-"))
    });
    format!("{titles}|{lines}\n{pictures}{captions}{given}")
}

fn title(setting: Setting) -> &'static str {
    if setting == Setting::Default { "default" } else { "changed" }
}

/// What a setting changes.
fn caption(block: &Block, setting: Setting) -> String {
    let changes = changes(block, setting);
    let words = changes.iter().map(|(parameter, value)| {
        let value = match parameter.choices.iter().find(|choice| *value == choice.number) {
            Some(choice) => choice.id.clone(),
            None => shown(value),
        };
        format!("{} {}", parameter.id, code(&value))
    });
    words.collect::<Vec<_>>().join("<br>")
}

fn shown(value: &serde_json::Value) -> String {
    match value.as_f64() {
        Some(value) => number(value),
        None => match value.as_bool() {
            Some(true) => "yes".to_owned(),
            Some(false) => "no".to_owned(),
            None => value_in_files(value),
        },
    }
}

fn inputs(block: &Block) -> String {
    if block.inputs.is_empty() {
        return "## Inputs\n\nNone.".to_owned();
    }
    let rows = block.inputs.iter().enumerate().map(|(slot, input)| {
        let need = if input.is_optional { "optional" } else { "needed" };
        [slot.to_string(), input.id.clone(), input.kind.clone(), need.to_owned()]
    });
    format!("## Inputs\n\n{}", table(["slot", "input", "kind", "connection"], rows))
}

fn outputs(block: &Block) -> String {
    if block.outputs.is_empty() {
        return String::new();
    }
    let rows = block.outputs.iter().map(|output| {
        let planes = match output.planes.as_deref() {
            Some("by parameters") => "grey or colour, as the parameters say".to_owned(),
            Some("as inputs") => "grey or colour, as the inputs are".to_owned(),
            planes => planes.unwrap_or("–").to_owned(),
        };
        [output.id.clone(), output.kind.clone(), planes]
    });
    format!("## Output\n\n{}", table(["output", "kind", "planes"], rows))
}

fn parameters(block: &Block) -> String {
    if block.parameters.is_empty() {
        return "## Parameters\n\nNone.".to_owned();
    }
    let titles = ["parameter", "kind", "default", "allowed", "usual", "unit", "meaning"];
    let rows = block.parameters.iter().map(|parameter| {
        [
            parameter.id.clone(),
            parameter.kind.word().to_owned(),
            default(parameter),
            range(parameter.hard),
            range(parameter.soft),
            parameter.unit.as_deref().map_or_else(|| "–".to_owned(), escaped),
            escaped(&parameter.doc),
        ]
    });
    format!("## Parameters\n\n{}{}", table(titles, rows), alternatives(block))
}

fn default(parameter: &Parameter) -> String {
    match parameter.choices.iter().find(|choice| parameter.default == choice.number) {
        Some(choice) => format!("{} ({})", choice.number, escaped(&choice.id)),
        None if parameter.kind == ParameterKind::Text => code(&value_in_files(&parameter.default)),
        None => match shown(&parameter.default) {
            text if text.is_empty() => "–".to_owned(),
            text => escaped(&text),
        },
    }
}

fn range(range: Option<Range>) -> String {
    range.map_or_else(
        || "–".into(),
        |range| format!("{} to {}", number(range.min), number(range.max)),
    )
}

/// The alternatives of choices; those of several are there once.
fn alternatives(block: &Block) -> String {
    let mut tables: Vec<(String, String)> = Vec::new();
    for parameter in block.parameters.iter().filter(|parameter| !parameter.choices.is_empty()) {
        let rows = parameter
            .choices
            .iter()
            .map(|choice| [choice.number.to_string(), escaped(&choice.id), escaped(&choice.doc)]);
        let text = table(["number", "alternative", "meaning"], rows);
        match tables.iter_mut().find(|(_, known)| *known == text) {
            Some((ids, _)) => ids.push_str(&format!(", {}", parameter.id)),
            None => tables.push((parameter.id.clone(), text)),
        }
    }
    tables.iter().map(|(ids, text)| format!("\n### {ids}\n\n{text}")).collect()
}

/// The block with what it needs, and with all of its parameters at their defaults.
fn sample(block: &Block) -> String {
    let mut children = String::new();
    let needed = block.inputs.iter().enumerate().filter(|(_, input)| !input.is_optional);
    let mut id = 1;
    for (slot, _) in needed {
        children.push_str(&format!("\t<input id=\"{id}\" slot=\"{slot}\"/>\n"));
        id += 1;
    }
    for parameter in &block.parameters {
        let value = value_in_files(&parameter.default);
        children.push_str(&format!("\t{}\n", pictures::parameter(parameter, &value)));
    }
    let head = format!("<block type=\"{}\" id=\"{id}\"", block.id);
    if children.is_empty() { format!("{head}/>") } else { format!("{head}>\n{children}</block>") }
}
