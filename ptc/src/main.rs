//! `ptc`: the command of ptlib. It renders graphs into pictures, checks graph files, and shows
//! what blocks there are.
//!
//! One file a subcommand: [`render`], [`list`], [`describe`], [`check`], [`plugins`],
//! [`check_plugin`]. What they share: [`exit`] (how the command ends), [`terminal`] (what people
//! see), [`description`] (a block in words, for people and as JSON), [`finding`] (a fault of a
//! graph file), [`plugins::PluginOptions`] (which plug-ins are loaded). Everything else is the library.

mod check;
mod check_plugin;
mod cli;
mod describe;
mod description;
mod exit;
mod finding;
mod interrupt;
mod list;
mod output;
mod pattern;
mod plugins;
mod progress;
mod quantity;
mod render;
mod terminal;

use std::process::ExitCode;

use clap::Parser as _;

use cli::{Cli, Command};
use exit::{Exit, Fault};

fn main() -> ExitCode {
    let ended = match Cli::try_parse() {
        Ok(cli) => run(&cli.command),
        Err(error) => cli::refuse(&error),
    };
    let exit = ended.unwrap_or_else(|fault| {
        fault.report();
        fault.exit
    });
    exit.into()
}

fn run(command: &Command) -> Result<Exit, Fault> {
    match command {
        Command::Render(arguments) => render::run(arguments),
        Command::List(arguments) => list::run(arguments),
        Command::Describe(arguments) => describe::run(arguments),
        Command::Check(arguments) => check::run(arguments),
        Command::Plugins(arguments) => plugins::run(arguments),
        Command::CheckPlugin(arguments) => check_plugin::run(arguments),
    }
}
