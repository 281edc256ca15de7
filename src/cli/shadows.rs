//! Whether shadows are cast.

use crate::render::Shadows;
use crate::visibility::Structures;

/// Options of every command that shades.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(super) struct ShadowArgs {
    /// Let every light reach everything.
    #[arg(long)]
    no_shadows: bool,
    /// How surfaces are found: every, grid[-N], light-buffer[-N] or hierarchy, or one of them for rays and one for
    /// shadows, such as grid-20/light-buffer-72. All give the same answer, at different speed.
    #[arg(long, default_value_t, value_name = "STRUCTURE", conflicts_with = "no_shadows")]
    structure: Structures,
}

impl ShadowArgs {
    /// What was asked for.
    pub(super) fn shadows(self) -> Shadows {
        if self.no_shadows { Shadows::None } else { Shadows::Cast(self.structure) }
    }
}
