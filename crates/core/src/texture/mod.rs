//! Which textures there are, and what a texture must answer.
//!
//! A texture is a colour that differs from point to point: a picture or a pattern. Materials name textures where a
//! colour or a fraction is [painted](Paint), as at [`Scene::add_texture`](crate::Scene::add_texture); before their
//! lobes are asked they are [resolved](crate::Surface::resolved) at a point. A new texture is one file here, its `mod`
//! line and its name in the list below.

mod brick;
mod checker;
mod fractal;
mod image;
mod image_texture;
mod marble;
mod noise;
mod paint;
mod point;
mod transform;
mod vertex_color;

pub use brick::BrickTexture;
pub use checker::CheckerTexture;
pub use image::{Encoding, Filter, Image, Levels, MOST_PIXELS, Wrap};
pub use image_texture::ImageTexture;
pub use marble::MarbleTexture;
pub use noise::NoiseTexture;
pub use paint::{Level, Paint, TextureSource, TextureUse};
pub use point::{Channel, Texel, TexturePoint};
pub use transform::Mapping;
pub use vertex_color::VertexColorTexture;

pub(crate) use paint::HalfGrey;
pub(crate) use transform::{facing, longitude_and_latitude};

use crate::Rgb;

/// What a texture provides to materials.
pub trait Pattern {
    /// The colour and the opacity at a point: on average over the point's footprint, if it has one.
    fn texel(&self, at: &TexturePoint) -> Texel;
}

crate::part::parts! {
    $ each_texture
    /// A texture.
    pub enum Texture {
        /// A picture from a file.
        ImageTexture,
        /// Clouds.
        NoiseTexture,
        /// Two colours in squares.
        CheckerTexture,
        /// Bricks and mortar.
        BrickTexture,
        /// Veins.
        MarbleTexture,
        /// Colours of a mesh's corners.
        VertexColorTexture,
    }
}

impl Texture {
    /// See [`Pattern::texel`].
    #[must_use]
    pub fn texel(&self, at: &TexturePoint) -> Texel {
        each_texture!(self, texture => texture.texel(at))
    }

    /// The colour at a point, linear Rec. 709.
    #[must_use]
    pub fn color(&self, at: &TexturePoint) -> Rgb {
        self.texel(at).color
    }
}

/// `from` where `share` is 0, `to` where it is 1, and in proportion between.
fn mixed(from: Rgb, to: Rgb, share: f64) -> Rgb {
    from * (1.0 - share) + to * share
}

#[cfg(test)]
mod tests;
