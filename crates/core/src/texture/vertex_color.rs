//! What a shape itself has of colour: that of a mesh's corners, as scanned and painted meshes bring it along.

use super::{Pattern, Texel, TexturePoint};
use crate::part::Given;
use crate::{Field, InvalidPart, Part, Rgb, Values};

/// The colours of a mesh's corners, in proportion between them; white where a shape has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct VertexColorTexture;

impl Part for VertexColorTexture {
    const NAME: &'static str = "vertex-color-texture";
    const DOC: &'static str = "The colours that the corners of a mesh have in its file.";
    const FIELDS: &'static [Field] = &[];

    fn make(_: &Given<'_>) -> Result<Self, InvalidPart> {
        Ok(Self)
    }

    fn values(&self) -> Values {
        Values::new()
    }
}

impl Pattern for VertexColorTexture {
    fn texel(&self, at: &TexturePoint) -> Texel {
        Texel::opaque(at.color.unwrap_or(Rgb::WHITE))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Texture;

    #[test]
    fn it_shows_the_colour_of_the_shape_and_white_without_one() {
        let texture = Texture::from(VertexColorTexture);
        let red = Rgb::new(0.5, 0.1, 0.0);
        let at = TexturePoint { color: Some(red), ..TexturePoint::default() };
        assert_eq!(texture.texel(&at), Texel::opaque(red));
        assert_eq!(texture.texel(&TexturePoint::default()), Texel::WHITE);
    }
}
