//! The program `wayside`; its commands are promised in `docs/interface.md`.

use std::process::ExitCode;

fn main() -> ExitCode {
    wayside::program::main()
}
