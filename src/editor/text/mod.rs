//! All texts of the studio. A translation is one more [`Text`], which the compiler holds to be complete.
//!
//! `{}` in a text stands for a number or a name ([`with`]). Sentences of the solver and of the document's check come from
//! there.

mod frame;
mod marks;
mod motion;
mod steps;
mod titles;

pub(super) use titles::title_words;

use std::fmt::Display;

/// Makes a struct of texts and its English form.
macro_rules! texts {
    ($(#[$meta:meta])* $name:ident, $english:ident { $($key:ident: $text:literal,)* }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug)]
        pub(crate) struct $name {
            $(pub(crate) $key: &'static str,)*
        }

        pub(super) const $english: $name = $name { $($key: $text,)* };
    };
}
use texts;

/// The language of the studio.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Language {
    /// English.
    #[default]
    English,
}

impl Language {
    /// The texts of the language.
    pub(super) fn text(self) -> &'static Text {
        match self {
            Self::English => &ENGLISH,
        }
    }
}

/// All texts of a language.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Text {
    pub(crate) bar: frame::Bar,
    pub(crate) dialog: frame::Dialog,
    pub(crate) suggest: frame::Suggest,
    pub(crate) step: steps::Steps,
    pub(crate) need: steps::Needs,
    pub(crate) report: steps::Report,
    pub(crate) mark: marks::Marks,
    pub(crate) region: marks::Regions,
    pub(crate) horizon: marks::Horizon,
    pub(crate) background: marks::Background,
    pub(crate) objects: marks::Objects,
    pub(crate) pairs: marks::Pairs,
    pub(crate) motion: motion::Motions,
    pub(crate) path: motion::Path,
    pub(crate) title: titles::Titles,
    pub(crate) session: frame::Session,
}

static ENGLISH: Text = Text {
    bar: frame::BAR,
    dialog: frame::DIALOG,
    suggest: frame::SUGGEST,
    step: steps::STEPS,
    need: steps::NEEDS,
    report: steps::REPORT,
    mark: marks::MARKS,
    region: marks::REGIONS,
    horizon: marks::HORIZON,
    background: marks::BACKGROUND,
    objects: marks::OBJECTS,
    pairs: marks::PAIRS,
    motion: motion::MOTIONS,
    path: motion::PATH,
    title: titles::TITLES,
    session: frame::SESSION,
};

/// A text with a value in the place of its `{}`.
pub(super) fn with(text: &str, value: impl Display) -> String {
    text.replacen("{}", &value.to_string(), 1)
}
