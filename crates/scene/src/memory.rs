//! How much memory is there for a picture, and how much has this process needed at the most?

/// Bytes that programs can still get, from `/proc/meminfo`; `None` on systems without it.
#[must_use]
pub fn free_bytes() -> Option<u64> {
    free_of(&std::fs::read_to_string("/proc/meminfo").ok()?)
}

fn free_of(info: &str) -> Option<u64> {
    kibibytes(info, "MemAvailable:")?.checked_add(kibibytes(info, "SwapFree:").unwrap_or(0))
}

/// The most bytes that this process has had in memory so far, from `VmHWM` of `/proc/self/status`; `None` on systems without
/// it.
#[must_use]
pub fn peak_bytes() -> Option<u64> {
    kibibytes(&std::fs::read_to_string("/proc/self/status").ok()?, "VmHWM:")
}

/// The bytes of a line of `/proc`, which counts in kibibytes.
fn kibibytes(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_of_the_peak_is_read() {
        assert_eq!(kibibytes("Name:\tx\nVmPeak:\t  9 kB\nVmHWM:\t  1234 kB\n", "VmHWM:"), Some(1234 * 1024));
    }

    #[test]
    fn a_status_without_it_has_none() {
        assert_eq!(kibibytes("Name:\tx\n", "VmHWM:"), None);
    }

    #[test]
    fn free_is_what_is_available_and_swap() {
        assert_eq!(free_of("MemFree: 1 kB\nMemAvailable:  20 kB\nSwapFree: 5 kB\n"), Some(25 * 1024));
        assert_eq!(free_of("MemAvailable:  20 kB\n"), Some(20 * 1024));
        assert_eq!(free_of("MemFree: 1 kB\n"), None);
    }
}
