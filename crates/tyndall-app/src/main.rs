//! `tyndall-app [SCENE]`: opens the window, with a scene file if one is named.

use std::{env, ffi::OsString, path::PathBuf, process::ExitCode};

use tyndall_app::{AppOptions, LogBuffer, run};
use tyndall_gpu::AdapterChoice;

const USAGE: &str = "usage: tyndall-app [--adapter ADAPTER] [SCENE]

Opens the Tyndall window, with the scene file SCENE if one is named.

options:
  --adapter ADAPTER  auto, software, an index such as 0, or a part of the name
  -h, --help         print this and end
  -V, --version      print the version and end

environment:
  RUST_LOG           what is logged, such as tyndall_gpu=debug

exit codes: 0 ok, 1 no window, 2 usage, 3 no graphics adapter";

/// Wrong arguments.
const EXIT_USAGE: u8 = 2;

/// What the arguments ask for.
enum Request {
    Open(Option<PathBuf>, AdapterChoice),
    Print(&'static str),
    Refuse(String),
}

fn request(arguments: impl IntoIterator<Item = OsString>) -> Request {
    let (mut scene, mut adapter) = (None, AdapterChoice::Auto);
    let mut arguments = arguments.into_iter();
    while let Some(argument) = arguments.next() {
        match argument.to_str() {
            Some("-h" | "--help") => return Request::Print(USAGE),
            Some("-V" | "--version") => return Request::Print(concat!("tyndall-app ", env!("CARGO_PKG_VERSION"))),
            Some("--adapter") => {
                let choice = arguments.next().unwrap_or_default();
                match choice.to_string_lossy().parse() {
                    Ok(choice) => adapter = choice,
                    Err(error) => return Request::Refuse(error.to_string()),
                }
            }
            Some(option) if option.starts_with('-') => return Request::Refuse(format!("unknown option `{option}`")),
            _ if scene.is_some() => return Request::Refuse("more than one scene".to_owned()),
            _ => scene = Some(PathBuf::from(argument)),
        }
    }
    Request::Open(scene, adapter)
}

#[expect(clippy::print_stdout, clippy::print_stderr, reason = "a program answers on the terminal")]
fn main() -> ExitCode {
    match request(env::args_os().skip(1)) {
        Request::Print(text) => {
            println!("{text}");
            ExitCode::SUCCESS
        }
        Request::Refuse(reason) => {
            eprintln!("tyndall-app: {reason}\n\n{USAGE}");
            ExitCode::from(EXIT_USAGE)
        }
        Request::Open(scene, adapter) => match LogBuffer::install() {
            Ok(log) => run(AppOptions { scene, data_dir: None, log, adapter }),
            Err(error) => {
                eprintln!("tyndall-app: the log cannot be set up: {error}");
                ExitCode::FAILURE
            }
        },
    }
}
