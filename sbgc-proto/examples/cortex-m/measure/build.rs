//! Tells the linker where the memory is.

use std::path::PathBuf;

fn main() {
    let folder = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it"));
    std::fs::write(folder.join("memory.x"), include_str!("../memory.x")).expect("cargo made the folder");
    println!("cargo::rustc-link-search={}", folder.display());
    println!("cargo::rerun-if-changed=../memory.x");
}
