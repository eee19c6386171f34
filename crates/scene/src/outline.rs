//! What scene text says, and where in the text it says it: the ground for building a scene and for changing the text.

use std::collections::HashMap;
use std::ops::Range;

use catoptra_core::scene::{Flags, Settings};
use catoptra_core::{
    Camera, Field, Finish, InvalidPart, Kind, Light, Material, Operation, Placement, Shape, Texture,
    TextureId, Values,
};

use crate::instance::ModelSource;

/// A place in the text, in bytes.
pub(crate) type Span = Range<usize>;

/// The kinds that a node can be of: every kind that the core lists, groups and settings.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Sort {
    Settings,
    Texture(&'static Kind<Texture>),
    Material(&'static Kind<Material>),
    Shape(&'static Kind<Shape>),
    Light(&'static Kind<Light>),
    Camera,
    Group,
    Solid(Operation),
    /// A model file: a group of what it holds.
    Model,
    /// What is said of one thing in a model file.
    Part,
    /// A group of copies of what stands in it, each a step on from the one before.
    Repeat,
}

/// The word for a group of entities.
pub(crate) const GROUP: &str = "group";

/// The word for what a model file holds.
pub(crate) const MODEL: &str = "model";

/// The word for what is said of one thing in a model file.
pub(crate) const PART: &str = "part";

/// The word for copies of what stands in a node.
pub(crate) const REPEAT: &str = "repeat";

impl Sort {
    /// The sort of node that a word stands for.
    pub(crate) fn named(word: &str) -> Option<Self> {
        if let Some(kind) = Shape::kind_named(word) {
            return Some(Self::Shape(kind));
        }
        if let Some(kind) = Light::kind_named(word) {
            return Some(Self::Light(kind));
        }
        if let Some(kind) = Material::kind_named(word) {
            return Some(Self::Material(kind));
        }
        if let Some(kind) = Texture::kind_named(word) {
            return Some(Self::Texture(kind));
        }
        match word {
            GROUP => Some(Self::Group),
            MODEL => Some(Self::Model),
            PART => Some(Self::Part),
            REPEAT => Some(Self::Repeat),
            _ if word == Camera::KIND.name => Some(Self::Camera),
            _ if word == Settings::KIND.name => Some(Self::Settings),
            _ => Operation::named(word).map(Self::Solid),
        }
    }

    /// Every word that [`Self::named`] knows; without materials, textures and settings where those cannot stand.
    pub(crate) fn words(in_group: bool) -> Vec<&'static str> {
        let mut words: Vec<&'static str> = Shape::KINDS.iter().map(|k| k.name).collect();
        words.extend(Light::KINDS.iter().map(|k| k.name));
        words.extend([Camera::KIND.name, GROUP, MODEL, REPEAT]);
        words.extend(Operation::ALL.map(Operation::word));
        if !in_group {
            words.extend(Material::KINDS.iter().map(|k| k.name));
            words.extend(Texture::KINDS.iter().map(|k| k.name));
            words.push(Settings::KIND.name);
        }
        words
    }

    /// Its word.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Settings => Settings::KIND.name,
            Self::Texture(kind) => kind.name,
            Self::Material(kind) => kind.name,
            Self::Shape(kind) => kind.name,
            Self::Light(kind) => kind.name,
            Self::Camera => Camera::KIND.name,
            Self::Group => GROUP,
            Self::Solid(operation) => operation.word(),
            Self::Model => MODEL,
            Self::Part => PART,
            Self::Repeat => REPEAT,
        }
    }

    /// Its fields; of a material also those that any has.
    pub(crate) fn fields(self) -> impl Iterator<Item = &'static Field> {
        let own: &[Field] = match self {
            Self::Settings => Settings::KIND.fields,
            Self::Texture(kind) => kind.fields,
            Self::Material(kind) => kind.fields,
            Self::Shape(kind) => kind.fields,
            Self::Light(kind) => kind.fields,
            Self::Camera => Camera::KIND.fields,
            Self::Group | Self::Solid(_) | Self::Model | Self::Part | Self::Repeat => &[],
        };
        let common: &[Field] = if matches!(self, Self::Material(_)) { Finish::KIND.fields } else { &[] };
        own.iter().chain(common)
    }

    /// The field of that name.
    pub(crate) fn field(self, name: &str) -> Option<&'static Field> {
        self.fields().find(|field| field.name == name)
    }

    /// Makes the part from its values.
    pub(crate) fn make(self, values: &Values) -> Result<Part, InvalidPart> {
        Ok(match self {
            Self::Settings => Part::Settings((Settings::KIND.make)(values)?),
            Self::Texture(kind) => Part::Texture((kind.make)(values)?),
            Self::Material(kind) => {
                let [own, finish] = [kind.fields, Finish::KIND.fields].map(|fields| only(values, fields));
                Part::Material(Box::new((kind.make)(&own)?), (Finish::KIND.make)(&finish)?)
            }
            Self::Shape(kind) => Part::Shape((kind.make)(values)?),
            Self::Light(kind) => Part::Light((kind.make)(values)?),
            Self::Camera => Part::Camera((Camera::KIND.make)(values)?),
            Self::Group | Self::Model | Self::Part | Self::Repeat => Part::Group,
            Self::Solid(operation) => Part::Solid(operation),
        })
    }

    /// Whether it is an entity: it stands somewhere, can be placed and can lie in a group.
    pub(crate) fn is_entity(self) -> bool {
        matches!(self, Self::Shape(_) | Self::Light(_) | Self::Camera) || self.has_members()
    }

    /// Whether others can lie in it.
    pub(crate) fn has_members(self) -> bool {
        matches!(self, Self::Group | Self::Solid(_) | Self::Model | Self::Part | Self::Repeat)
    }
}

/// The values whose names are those of fields in the list.
fn only(values: &Values, fields: &[Field]) -> Values {
    let known = values.iter().filter(|(name, _)| fields.iter().any(|field| field.name == *name));
    known.fold(Values::new(), |all, (name, value)| all.with(name, value.clone()))
}

/// What a node makes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Part {
    Settings(Settings),
    Texture(Texture),
    Material(Box<Material>, Finish),
    Shape(Shape),
    Light(Light),
    Camera(Camera),
    Group,
    Solid(Operation),
}

impl Part {
    /// The sort of node that makes it.
    pub(crate) fn sort(&self) -> Sort {
        match self {
            Self::Settings(_) => Sort::Settings,
            Self::Texture(texture) => Sort::Texture(texture.kind()),
            Self::Material(material, _) => Sort::Material(material.kind()),
            Self::Shape(shape) => Sort::Shape(shape.kind()),
            Self::Light(light) => Sort::Light(light.kind()),
            Self::Camera(_) => Sort::Camera,
            Self::Group => Sort::Group,
            Self::Solid(operation) => Sort::Solid(*operation),
        }
    }

    /// Its values by field name.
    pub(crate) fn values(&self) -> Values {
        match self {
            Self::Settings(settings) => settings.values(),
            Self::Texture(texture) => texture.values(),
            Self::Material(material, finish) => {
                let finish = catoptra_core::Part::values(finish);
                finish.iter().fold(material.values(), |all, (name, value)| all.with(name, value.clone()))
            }
            Self::Shape(shape) => shape.values(),
            Self::Light(light) => light.values(),
            Self::Camera(camera) => catoptra_core::Part::values(camera),
            Self::Group | Self::Solid(_) => Values::new(),
        }
    }
}

/// A word of the text, and where it stands with its quotes.
#[derive(Debug, Clone)]
pub(crate) struct Word {
    pub(crate) value: String,
    pub(crate) span: Span,
}

/// Where a field is written.
#[derive(Debug, Clone)]
pub(crate) struct FieldText {
    pub(crate) field: &'static Field,
    /// The child node or the property.
    pub(crate) span: Span,
    /// Its values.
    pub(crate) values: Vec<Span>,
    /// Whether it is a property of its node.
    pub(crate) property: bool,
    /// Its value, where that is the name of a texture.
    pub(crate) word: Option<String>,
    /// The texture that multiplies its value.
    pub(crate) painted: Option<Painted>,
}

/// The texture that multiplies a value, as written.
#[derive(Debug, Clone, Default)]
pub(crate) struct Painted {
    pub(crate) texture: Option<Word>,
    pub(crate) channel: Option<Word>,
    /// The properties, with their names.
    pub(crate) spans: Vec<Span>,
}

/// Where it is said whether something is hidden, or locked.
#[derive(Debug, Clone)]
pub(crate) struct FlagText {
    /// The word: see [`flags`](crate::flags).
    pub(crate) word: &'static str,
    /// The child node or the property.
    pub(crate) span: Span,
    /// Whether it is a property of its node.
    pub(crate) property: bool,
}

/// One step of a placement, as written.
#[derive(Debug, Clone)]
pub(crate) struct StepText {
    pub(crate) span: Span,
    pub(crate) numbers: Vec<Span>,
    pub(crate) is_move: bool,
    /// The placement before this step.
    pub(crate) before: Placement,
}

/// A node: a material, a texture, an entity or the settings.
#[derive(Debug, Clone)]
pub(crate) struct Item {
    pub(crate) sort: Sort,
    /// The whole node, without space before or after.
    pub(crate) span: Span,
    /// The word for its kind.
    pub(crate) word: Span,
    /// The end of its last word before a block.
    pub(crate) head_end: usize,
    /// Its name; settings have none.
    pub(crate) name: Option<Word>,
    /// The material that a shape wears.
    pub(crate) material: Option<Word>,
    /// Where the whole property stands that names it.
    pub(crate) worn: Option<Span>,
    pub(crate) fields: Vec<FieldText>,
    pub(crate) steps: Vec<StepText>,
    pub(crate) placement: Placement,
    /// The values of its fields, as far as they could be read.
    pub(crate) given: Values,
    /// What it makes; `None` if that was complained about.
    pub(crate) part: Option<Part>,
    /// The group that it is a member of, as its place in [`Outline::items`].
    pub(crate) parent: Option<usize>,
    /// The file of a model, if it could be read.
    pub(crate) model: Option<ModelSource>,
    /// Where the path of that file is written.
    pub(crate) model_path: Option<Span>,
    /// Whether a part of a model is left out.
    pub(crate) removed: bool,
    /// Where that is said: the child node, or the property.
    pub(crate) remove: Option<(Span, bool)>,
    /// How often all that stands in a repeat is there.
    pub(crate) count: Option<u32>,
    /// From one copy in a repeat to the next.
    pub(crate) step: Option<Placement>,
    /// Whether it is hidden or locked.
    pub(crate) flags: Flags,
    /// Where that is said.
    pub(crate) flag_texts: Vec<FlagText>,
}

impl Item {
    /// A node of which nothing is known yet but where it stands.
    pub(crate) fn new(sort: Sort, span: Span, word: Span, head_end: usize, parent: Option<usize>) -> Self {
        Self {
            sort,
            span,
            word,
            head_end,
            name: None,
            material: None,
            worn: None,
            fields: Vec::new(),
            steps: Vec::new(),
            placement: Placement::IDENTITY,
            given: Values::new(),
            part: None,
            parent,
            model: None,
            model_path: None,
            removed: false,
            remove: None,
            count: None,
            step: None,
            flags: Flags::default(),
            flag_texts: Vec::new(),
        }
    }
}

/// All nodes of a text, in order: a group stands before its members.
#[derive(Debug, Clone, Default)]
pub(crate) struct Outline {
    pub(crate) items: Vec<Item>,
    /// The ids that the names of textures stand for.
    pub(crate) textures: HashMap<String, TextureId>,
}

impl Outline {
    /// The places of all that lies in an item.
    pub(crate) fn inside(&self, place: usize) -> std::ops::Range<usize> {
        let end = self.items[place].span.end;
        let inside = self.items[place + 1..].iter().take_while(|item| item.span.start < end).count();
        place + 1..place + 1 + inside
    }

    /// The innermost repeat that an item stands in.
    pub(crate) fn repeat_round(&self, item: &Item) -> Option<usize> {
        let mut outer = item.parent;
        while let Some(place) = outer.filter(|place| !matches!(self.items[*place].sort, Sort::Repeat)) {
            outer = self.items[place].parent;
        }
        outer
    }
}
