//! Whether shadows are cast.

use crate::render::Shadows;
use crate::visibility::Structure;

/// Options of every command that shades.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct ShadowArgs {
    /// Let every light reach everything.
    #[arg(long)]
    no_shadows: bool,
    /// How the surfaces that may cast a shadow are found: all give the same answer, at different speed.
    #[arg(long, default_value_t, value_name = "STRUCTURE", conflicts_with = "no_shadows")]
    structure: Structure,
}

impl ShadowArgs {
    /// What was asked for.
    pub(super) fn shadows(self) -> Shadows {
        if self.no_shadows { Shadows::None } else { Shadows::Cast(self.structure) }
    }
}
