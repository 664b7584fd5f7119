//! What is wrong with a command line, in one line that leads on.

use super::error::{CommandError, ParseStop, one_line};
use super::{Cli, meant};
use crate::files::printable;
use clap::CommandFactory;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;
use std::path::Path;

/// Options of all commands that take a value: what follows is no command.
const WITH_VALUE: [&str; 1] = ["--log"];

/// What ended the reading of `args`: help, the version, or what is wrong with them.
pub fn stop(error: clap::Error, args: &[OsString]) -> ParseStop {
    if matches!(error.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) {
        return ParseStop::Information(error);
    }
    ParseStop::Wrong(CommandError::Usage(explained(&error, args)))
}

/// For a first word that is no command and no file.
pub fn unknown_word(word: &str) -> CommandError {
    let root = Cli::command();
    let names: Vec<&str> = root.get_subcommands().map(clap::Command::get_name).collect();
    let shown = printable(word);
    // What has an ending is meant as a file.
    let path = Path::new(word);
    if path.extension().is_some() || path.components().count() > 1 {
        let advice = meant::like(path).unwrap_or_else(|| "`plushwright help` lists the commands".into());
        return CommandError::input(path, format!("no such file; {advice}"));
    }
    CommandError::Usage(match meant::command(word, names) {
        Some(command) => format!("`{shown}` is no command; did you mean `plushwright {command}`?"),
        None => format!("`{shown}` is neither a command nor a file; `plushwright help` lists the commands"),
    })
}

/// For a design that stands before the command.
pub fn command_late(design: &Path, args: &[OsString]) -> CommandError {
    let name = printable(&design.to_string_lossy());
    let known = Cli::command();
    let called = args.iter().filter_map(|arg| arg.to_str()).find_map(|word| known.find_subcommand(word));
    match called {
        Some(called) if design.exists() => {
            CommandError::Usage(format!("the command comes first: `plushwright {} {name}`", called.get_name()))
        }
        _ => unknown_word(&name),
    }
}

fn explained(error: &clap::Error, args: &[OsString]) -> String {
    let root = Cli::command();
    let words: Vec<&str> = args.iter().skip(1).filter_map(|arg| arg.to_str()).collect();
    let is_value = |k: usize| k > 0 && WITH_VALUE.contains(&words[k - 1]);
    let first = (0..words.len()).find(|&k| !words[k].starts_with('-') && !is_value(k)).map(|k| words[k]);
    let command = first.and_then(|word| root.find_subcommand(word));
    if let (Some(word), None) = (first, command)
        && word != "help"
    {
        let later = words.iter().find_map(|word| root.find_subcommand(word));
        return match later {
            _ if !Path::new(word).exists() => return unknown_word(word).to_string(),
            Some(later) => format!("the command comes first: `plushwright {} {}`", later.get_name(), printable(word)),
            None => clause(error, None),
        };
    }
    clause(error, command)
}

/// The fault in a clause, and what helps: the word that was meant, the values that there are, an example.
fn clause(error: &clap::Error, command: Option<&clap::Command>) -> String {
    // clap explains itself in paragraphs; the first one says what is wrong, the others repeat the usage.
    let text = error.render().to_string();
    let what = one_line(text.split("\n\n").next().unwrap_or_default().trim().trim_start_matches("error:"));
    let suggested = [ContextKind::SuggestedArg, ContextKind::SuggestedSubcommand, ContextKind::SuggestedValue];
    let suggested = suggested.into_iter().find_map(|kind| error.get(kind)).and_then(best_of);
    let suggested = suggested.or_else(|| command.is_none().then(|| helped(error)).flatten());
    if let Some(suggested) = suggested {
        return format!("{what}; did you mean `{suggested}`?");
    }
    let example = command.and_then(example).filter(|_| error.kind() == ErrorKind::MissingRequiredArgument);
    match (example, command) {
        (Some(example), _) => format!("{what}; for example `{example}`"),
        (None, Some(command)) => format!("{what} (`plushwright help {}` explains)", command.get_name()),
        (None, None) => format!("{what} (`plushwright help` explains)"),
    }
}

/// The command that `help` may have been asked for.
fn helped(error: &clap::Error) -> Option<String> {
    let Some(ContextValue::String(word)) = error.get(ContextKind::InvalidSubcommand) else { return None };
    let root = Cli::command();
    meant::command(word, root.get_subcommands().map(clap::Command::get_name)).map(str::to_owned)
}

fn best_of(value: &ContextValue) -> Option<String> {
    match value {
        ContextValue::String(text) => Some(text.clone()),
        // The most alike is the last.
        ContextValue::Strings(texts) => texts.last().cloned(),
        _ => None,
    }
}

/// The example at the end of a command's help.
fn example(command: &clap::Command) -> Option<String> {
    let text = command.get_after_help()?.to_string();
    text.split_once("Example: ").map(|(_, example)| one_line(example))
}
