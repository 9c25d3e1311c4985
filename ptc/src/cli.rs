//! The command line as a whole, and how a wrong one is refused.

use clap::{Parser, Subcommand, error::ErrorKind};

use crate::{
    check::CheckArguments,
    check_plugin::CheckPluginArguments,
    describe::DescribeArguments,
    exit::{Exit, Fault},
    list::ListArguments,
    plugins::PluginsArguments,
    render::RenderArguments,
};

const EXIT_CODES: &str = "\
Exit codes:
  0    done
  1    a file or a computation failed, `check` found an error, or a plug-in was refused
  2    the command line makes no sense; nothing was done
  3    some graphs of a batch failed, the others were rendered
  130  cancelled by Ctrl-C";

/// Procedural textures: renders graphs of blocks into pictures.
#[derive(Debug, Parser)]
#[command(version, after_help = EXIT_CODES, max_term_width = 100)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render graphs into pictures.
    Render(Box<RenderArguments>),
    /// List the block types.
    List(ListArguments),
    /// Describe a block type: its inputs, outputs and parameters.
    Describe(DescribeArguments),
    /// Check graph files and show every fault with its line and column.
    Check(CheckArguments),
    /// Show which plug-ins are found where, and why something is none.
    Plugins(PluginsArguments),
    /// Check a plug-in: whether it keeps what the contract promises.
    CheckPlugin(CheckPluginArguments),
}

/// Answers what `clap` did not take as a command: shows the help or the version that was asked
/// for, and makes everything else a fault of one line.
pub(crate) fn refuse(error: &clap::Error) -> Result<Exit, Fault> {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            error.print()?;
            Ok(Exit::Success)
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            error.print()?;
            Ok(Exit::Usage)
        }
        _ => {
            let (message, hint) = one_line(&error.render().to_string());
            Err(Fault::usage(message, hint))
        }
    }
}

/// The message and the hint in the several paragraphs of an error of `clap`: its tip, or how the
/// command is used.
fn one_line(text: &str) -> (String, String) {
    let paragraphs = text.split("\n\n").map(|paragraph| {
        let words: Vec<_> = paragraph.split_whitespace().collect();
        words.join(" ")
    });
    let paragraphs: Vec<_> = paragraphs.collect();
    let starting = |word| paragraphs.iter().find_map(|paragraph| paragraph.strip_prefix(word));
    let message = starting("error: ").unwrap_or(text.trim()).to_owned();
    let hint = match (starting("tip: "), starting("Usage: ")) {
        (Some(tip), _) => tip.replace(" tip: ", "; "),
        (None, Some(usage)) => format!("usage: {usage}"),
        (None, None) => "--help shows what is allowed".to_owned(),
    };
    (message, hint)
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;

    #[test]
    fn the_declaration_is_sound() {
        Cli::command().debug_assert();
    }

    #[test]
    fn a_wrong_command_line_is_refused_in_one_line() {
        let refused = |line: &str| {
            let error = Cli::try_parse_from(line.split(' ')).unwrap_err();
            one_line(&error.render().to_string())
        };
        let (message, hint) = refused("ptc list --jsn");
        assert_eq!(message, "unexpected argument '--jsn' found");
        assert_eq!(hint, "a similar argument exists: '--json'");
        let (message, hint) = refused("ptc render a.xml");
        assert!(message.ends_with("not provided: --output <FILE|PATTERN>"), "{message}");
        assert_eq!(hint, "usage: ptc render --output <FILE|PATTERN> <GRAPH>...");
        let (message, hint) = refused("ptc render a.xml -o a.png --precision 9");
        assert!(message.ends_with("[possible values: 8, float]"), "{message}");
        assert_eq!(hint, "--help shows what is allowed");
    }
}
