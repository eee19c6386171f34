//! How much memory has this process needed at the most?

/// Peak resident memory in bytes, from `VmHWM` of `/proc/self/status`; `None` on systems without it.
pub(crate) fn peak_bytes() -> Option<u64> {
    peak_of(&std::fs::read_to_string("/proc/self/status").ok()?)
}

fn peak_of(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::peak_of;

    #[test]
    fn the_line_of_the_peak_is_read() {
        assert_eq!(peak_of("Name:\tx\nVmPeak:\t  9 kB\nVmHWM:\t  1234 kB\n"), Some(1234 * 1024));
    }

    #[test]
    fn a_status_without_it_has_none() {
        assert_eq!(peak_of("Name:\tx\n"), None);
    }
}
