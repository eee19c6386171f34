//! What do the shapes of a file wear that names no materials: grey, the colours of their corners, or a picture?

use std::sync::Arc;

use catoptra_core::material::Matte;
use catoptra_core::texture::{ImageTexture, TextureUse, VertexColorTexture};
use catoptra_core::{
    Finish, Image, ImageSource, InvalidPart, Material, Rgb, Texture, TextureId, Value, Values,
};

use super::{Model, ModelMaterial};

/// The word for a texture of corners' colours.
const COLORS: &str = "vertex colors";

/// Adds a texture under its id; `None` beyond 2³² of them.
pub(super) fn add_texture(model: &mut Model, name: String, texture: Texture) -> Option<TextureId> {
    model.textures.push((name, texture));
    u32::try_from(model.textures.len()).ok().and_then(TextureId::from_index)
}

/// The texture that shows the colours of corners; a model has one at most.
pub(super) fn vertex_colors(model: &mut Model) -> Option<TextureUse> {
    let place = model.textures.iter().position(|(name, _)| name == COLORS);
    let known = place.and_then(|place| TextureId::from_index(place as u32 + 1));
    known.or_else(|| add_texture(model, COLORS.to_owned(), VertexColorTexture.into())).map(TextureUse::of)
}

/// A picture as a texture of a model.
///
/// # Errors
/// A value that the texture refuses.
pub(super) fn image_texture(path: &str, image: Arc<Image>, values: Values) -> Result<Texture, InvalidPart> {
    let source = ImageSource { path: path.to_owned(), image };
    catoptra_core::part::make::<ImageTexture>(&values.with("file", Value::Image(source))).map(Texture::from)
}

/// What shapes without a material wear: a `matte` of four fifths, or white where a texture covers it.
///
/// # Errors
/// None but what a constant could have.
pub(super) fn plain(texture: Option<TextureUse>) -> Result<ModelMaterial, InvalidPart> {
    let Some(by) = texture else { return ModelMaterial::grey() };
    let white = Material::from(Matte::new(Rgb::WHITE)?);
    let material = white.with("color", Value::Color(Rgb::WHITE).textured(by))?;
    Ok(ModelMaterial { name: "painted".to_owned(), material, finish: Finish::default() })
}
