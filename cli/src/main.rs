//! The program `drape`, which is in the library beside it: that is compiled while the engine still is, a program only after it.

#![forbid(unsafe_code)]

fn main() -> std::process::ExitCode {
    drape_cli::main()
}
