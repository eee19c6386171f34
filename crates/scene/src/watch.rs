//! Who is told how far the reading of a scene is, and may stop it?

use std::sync::Arc;

use catoptra_core::Control;

/// Whoever watches the reading of a scene; nobody by default.
#[derive(Debug, Clone, Default)]
pub(crate) struct Watch(Option<Arc<Control>>);

impl Watch {
    pub(crate) fn by(control: &Arc<Control>) -> Self {
        Self(Some(Arc::clone(control)))
    }

    /// Text of so many bytes is read now.
    pub(crate) fn start(&self, bytes: usize) {
        if let Some(control) = &self.0 {
            control.start(bytes);
        }
    }

    /// So many bytes of the text are read, and the files that they name.
    pub(crate) fn advance(&self, bytes: usize) {
        if let Some(control) = &self.0 {
            control.advance(bytes);
        }
    }

    /// That nothing more is to be read, in words.
    ///
    /// # Errors
    /// Just that.
    pub(crate) fn check(&self) -> Result<(), String> {
        self.0.as_ref().map_or(Ok(()), |control| control.check().map_err(|cancelled| cancelled.to_string()))
    }
}
