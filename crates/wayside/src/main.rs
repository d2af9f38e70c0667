//! The program `wayside`; `docs/interface.md` specifies its commands.

use std::process::ExitCode;

fn main() -> ExitCode {
    wayside::program::main()
}
