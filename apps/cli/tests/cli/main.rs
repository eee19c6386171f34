//! Does the program `catoptra` keep what it promises to scripts: exit codes, messages, whole files?

mod checks;
mod compare;
mod explain;
#[cfg(unix)]
mod files;
mod film;
mod input;
mod lab;
mod layers;
mod outputs;
#[cfg(unix)]
mod printing;
mod probe;
mod program;
mod rays;
mod render;
mod targets;
mod usage;
mod warnings;
