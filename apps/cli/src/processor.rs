//! Which processor does this program run on?

use serde_json::{Value, json};

/// Its name and how many threads it runs at once.
pub(crate) fn as_json() -> Value {
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    json!({ "name": name(), "architecture": std::env::consts::ARCH, "threads": threads })
}

/// What the system calls it; `None` on systems without `/proc/cpuinfo`, and where that names none.
fn name() -> Option<String> {
    name_of(&std::fs::read_to_string("/proc/cpuinfo").ok()?)
}

fn name_of(info: &str) -> Option<String> {
    let named = |line: &str| {
        line.split_once(':').filter(|(key, _)| key.trim() == "model name").map(|(_, v)| v.trim().to_owned())
    };
    info.lines().find_map(named).filter(|name| !name.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_is_that_of_the_first_core() {
        let info = "processor\t: 0\nmodel name\t: Some CPU @ 2.0GHz\nprocessor : 1\nmodel name : Other\n";
        assert_eq!(name_of(info).as_deref(), Some("Some CPU @ 2.0GHz"));
        assert_eq!(name_of("processor : 0\n"), None);
    }
}
