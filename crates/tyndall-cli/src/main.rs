//! The program `tyndall`; everything is in the library, where tests reach it.

use std::process::ExitCode;

fn main() -> ExitCode {
    tyndall_cli::run(std::env::args_os())
}
