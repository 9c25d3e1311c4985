//! What differs on a terminal: colours, widths, progress, Ctrl-C.

#![cfg(unix)]

mod support;

use std::{
    fs::File,
    io::Read as _,
    process::{Child, Command},
};

use rustix::{
    fs::{Mode, OFlags},
    process::{Pid, Signal, kill_process},
    pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt},
    termios::{Winsize, tcsetwinsize},
};
use support::{Folder, end, graph, noise, ptc};

const COLUMNS: u16 = 60;
const ESCAPE: char = '\u{1b}';

/// A program whose outputs are a terminal.
struct Session {
    screen: File,
    child: Child,
    text: String,
}

impl Session {
    fn start(mut command: Command) -> Self {
        let screen = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
        grantpt(&screen).unwrap();
        unlockpt(&screen).unwrap();
        let name = ptsname(&screen, Vec::new()).unwrap();
        let line = rustix::fs::open(name, OFlags::RDWR | OFlags::NOCTTY, Mode::empty()).unwrap();
        let size = Winsize { ws_row: 24, ws_col: COLUMNS, ws_xpixel: 0, ws_ypixel: 0 };
        tcsetwinsize(&line, size).unwrap();
        command.env("TERM", command_terminal(&command));
        command.stdout(line.try_clone().unwrap()).stderr(line);
        let child = command.spawn().expect("the program starts");
        Self { screen: File::from(screen), child, text: String::new() }
    }

    /// Reads until the text so far holds `part` or the program has ended; says which.
    fn reads_until(&mut self, part: &str) -> bool {
        let mut bytes = [0; 1024];
        while !self.text.contains(part) {
            // When the other side of a terminal is gone, Linux says "input/output error".
            match self.screen.read(&mut bytes) {
                Ok(0) | Err(_) => return false,
                Ok(count) => self.text.push_str(&String::from_utf8_lossy(&bytes[..count])),
            }
        }
        true
    }

    /// Everything that was shown, and the exit code.
    fn end(mut self) -> (String, Option<i32>) {
        while self.reads_until("text that no program shows") {}
        (self.text, self.child.wait().unwrap().code())
    }
}

/// The terminal's type, unless the test chose one.
fn command_terminal(command: &Command) -> String {
    let chosen = command.get_envs().find(|(name, _)| *name == "TERM");
    let chosen = chosen.and_then(|(_, value)| value?.to_str());
    chosen.unwrap_or("xterm-256color").to_owned()
}

fn shown(arguments: &[&str], environment: &[(&str, &str)]) -> String {
    let mut command = ptc();
    // What the tests themselves run in must not decide: a continuous integration shows colours.
    for name in ["CI", "NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
        command.env_remove(name);
    }
    command.args(arguments).envs(environment.iter().copied());
    Session::start(command).end().0
}

/// Many blurs of a noise: it takes seconds at a few thousand pixels, and little memory.
fn slow() -> String {
    let mut blocks = "<block type=\"perlin noise\" id=\"0\"/>\n".to_owned();
    for id in 1..=60 {
        let input = format!("<input id=\"{}\" slot=\"0\"/>", id - 1);
        blocks += &format!("<block type=\"blur\" id=\"{id}\">{input}</block>\n");
    }
    graph(&format!("{blocks}{}", end("61", "60")))
}

#[test]
fn colours_appear_where_they_are_wanted() {
    for arguments in [&["list"][..], &["describe", "end"], &["describe", "ned"]] {
        assert!(shown(arguments, &[]).contains(ESCAPE), "{arguments:?}");
        assert!(!shown(arguments, &[("NO_COLOR", "1")]).contains(ESCAPE), "{arguments:?}");
        assert!(!shown(arguments, &[("TERM", "dumb")]).contains(ESCAPE), "{arguments:?}");
    }
}

#[test]
fn texts_fit_the_terminal() {
    for arguments in [&["list"][..], &["describe", "blur"]] {
        let text = shown(arguments, &[("NO_COLOR", "1")]);
        let widest = text.lines().map(|line| line.trim_end().chars().count()).max().unwrap();
        assert!((40..=usize::from(COLUMNS)).contains(&widest), "{text}");
    }
}

#[test]
fn quick_work_shows_no_progress() {
    let folder = Folder::new("terminal_quick");
    folder.write("a.xml", &noise());
    let mut command = ptc();
    command.current_dir(folder.path(".")).args(["render", "a.xml", "-o", "a.png"]);
    assert_eq!(Session::start(command).end(), (String::new(), Some(0)));
}

#[test]
fn an_interrupt_cancels_and_leaves_nothing_behind() {
    let folder = Folder::new("terminal_interrupt");
    folder.write("slow.xml", &slow());
    let mut command = ptc();
    command.current_dir(folder.path("."));
    command.args(["render", "slow.xml", "-o", "slow.png", "--size", "4096", "--threads", "1"]);
    let mut session = Session::start(command);
    assert!(session.reads_until("slow.xml ["), "no progress in {:?}", session.text);
    let id = Pid::from_child(&session.child);
    kill_process(id, Signal::INT).unwrap();
    let (text, code) = session.end();
    assert_eq!(code, Some(130), "{text}");
    assert!(text.ends_with("ptc: cancelled\r\n"), "{text:?}");
    assert_eq!(folder.names(), ["slow.xml"]);
}
