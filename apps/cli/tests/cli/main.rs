//! Does the program `catoptra` keep what it promises to scripts: exit codes, messages, whole files?

mod compare;
mod explain;
mod lab;
mod program;
mod render;
mod usage;
