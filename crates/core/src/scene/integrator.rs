//! Which integrators there are to choose from, by name: what a picture shows of the light that arrives at its camera.
//!
//! How each one gathers light is the tracer's matter, whose list of rules has one for every name here.

/// Declares the enum and its tables: a variant, its name in scene text, and one sentence.
macro_rules! integrators {
    ($($variant:ident = $name:literal, $doc:literal;)+) => {
        /// What a picture shows. The default is the first.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Integrator { $(#[doc = $doc] $variant),+ }

        impl Integrator {
            /// Every integrator there is, the default first.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Their names in scene text and on the command line, in the same order.
            pub const NAMES: &'static [&'static str] = &[$($name),+];

            /// Its name in scene text and on the command line.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),+ }
            }

            /// One sentence.
            #[must_use]
            pub const fn doc(self) -> &'static str {
                match self { $(Self::$variant => $doc),+ }
            }
        }
    };
}

integrators! {
    Whitted = "whitted", "Direct light with shadows, mirror reflections and refraction.";
    Path = "path", "All light, by chance: without any error but noise, which more samples lessen.";
    Occlusion = "occlusion", "Ambient occlusion: the share of the sky that a surface sees, whatever its material.";
}

impl Integrator {
    /// The integrator of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|integrator| integrator.name() == name)
    }
}

impl Default for Integrator {
    fn default() -> Self {
        Self::ALL[0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_integrator_is_found_by_its_name_and_has_a_sentence() {
        for (integrator, name) in Integrator::ALL.iter().zip(Integrator::NAMES) {
            assert_eq!((Integrator::named(name), integrator.name()), (Some(*integrator), *name));
            assert!(integrator.doc().ends_with('.'), "{name}");
        }
        assert_eq!(Integrator::named("radiosity"), None);
    }
}
