//! Which of the CPU's vector instructions the wide backend uses.

use fearless_simd::Level;

/// Vector instructions that this CPU has: a value is the proof of it. Pictures do not depend on which are used.
#[derive(Clone, Copy)]
pub struct Instructions {
    level: Level,
}

impl Instructions {
    /// The best there are.
    #[must_use]
    pub fn best() -> Self {
        Self::all().swap_remove(0)
    }

    /// Every kind that this CPU has, the best first; never empty. Of the x86 family three kinds are distinguished, since
    /// each costs its time to compile; elsewhere there is one.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let native = Level::new();
        #[cfg(target_arch = "x86_64")]
        let levels = {
            let avx512 = native.as_avx512().map(Level::Avx512);
            let avx2 = native.as_avx2().map(Level::Avx2);
            avx512.into_iter().chain(avx2).chain(native.as_sse2().map(Level::Sse2))
        };
        #[cfg(not(target_arch = "x86_64"))]
        let levels = std::iter::once(native);
        levels.map(|level| Self { level }).collect()
    }

    /// The instructions of that name, if this CPU has them.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|instructions| instructions.name() == name)
    }

    /// Their name on the command line, such as `avx512`.
    #[must_use]
    pub fn name(self) -> &'static str {
        // A level and its proof print as `Avx512(Avx512 { .. })`.
        let level = format!("{:?}", self.level).to_lowercase();
        Self::NAMES.iter().copied().find(|name| level.starts_with(name)).unwrap_or("fallback")
    }

    /// The names of all kinds that any CPU may have.
    pub const NAMES: &'static [&'static str] = &["avx512", "avx2", "sse2", "neon", "wasmsimd128", "fallback"];

    /// The proof.
    pub(crate) fn level(self) -> Level {
        self.level
    }
}

impl std::fmt::Debug for Instructions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl PartialEq for Instructions {
    fn eq(&self, other: &Self) -> bool {
        std::mem::discriminant(&self.level) == std::mem::discriminant(&other.level)
    }
}

impl Eq for Instructions {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_there_is_has_a_name_of_its_own_and_is_found_by_it() {
        for instructions in Instructions::all() {
            assert!(Instructions::NAMES.contains(&instructions.name()));
            assert_eq!(Instructions::named(instructions.name()), Some(instructions));
        }
        assert_eq!(Instructions::named("mmx"), None);
    }
}
