//! The program `bryla`; see the module `cli` of the crate.

fn main() {
    std::process::exit(bryla::cli::main(std::env::args_os()));
}
