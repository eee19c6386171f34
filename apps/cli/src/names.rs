//! What do names on the command line stand for? Unknown ones are refused, with what was perhaps meant.

use catoptra_core::Integrator;
use catoptra_tracer::{Backend, Edges, Filter, Instructions, Pattern, backend_named, backends};
use miette::{Result, miette};

use crate::suggest::unknown;

pub(crate) fn find_backend(name: &str) -> Result<&'static dyn Backend> {
    let names = || backends().iter().map(|backend| backend.name()).collect::<Vec<_>>();
    backend_named(name).ok_or_else(|| unknown("backend", name, &names()))
}

pub(crate) fn find_integrator(name: &str) -> Result<Integrator> {
    Integrator::named(name).ok_or_else(|| unknown("integrator", name, Integrator::NAMES))
}

pub(crate) fn find_pattern(name: &str) -> Result<Pattern> {
    let names: Vec<&str> = Pattern::ALL.iter().map(|pattern| pattern.name()).collect();
    Pattern::named(name).ok_or_else(|| unknown("pattern of samples", name, &names))
}

pub(crate) fn find_filter(name: &str) -> Result<Filter> {
    let names: Vec<&str> = Filter::ALL.iter().map(|filter| filter.name()).collect();
    Filter::named(name).ok_or_else(|| unknown("filter", name, &names))
}

pub(crate) fn find_edges(name: &str) -> Result<Edges> {
    let names: Vec<&str> = Edges::ALL.iter().map(|edges| edges.name()).collect();
    Edges::named(name).ok_or_else(|| unknown("way to show edges", name, &names))
}

/// The instructions of that name; an error where there are none such, or not on this CPU.
pub(crate) fn find_instructions(name: &str) -> Result<Instructions> {
    let here: Vec<&str> = Instructions::all().into_iter().map(Instructions::name).collect();
    Instructions::named(name).ok_or_else(|| {
        if Instructions::NAMES.contains(&name) {
            miette!(help = format!("it has: {}", here.join(", ")), "this CPU has no {name}")
        } else {
            unknown("level of instructions", name, &here)
        }
    })
}
