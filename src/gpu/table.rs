//! Large tables that light shaders read.

use std::sync::Arc;

use super::types::f32_of;
use super::{cells, textured};
use crate::light::pattern::Channel;
use crate::light::photometry::Distribution;
use crate::shading::one_shot::{Kernel, Prefiltered};

/// A table by what it is made of; equal where that is the very same.
#[derive(Clone, Debug, Default)]
pub(crate) enum Table {
    /// One zero.
    #[default]
    None,
    /// A prefiltered pattern's sums over a kernel.
    Pattern(Arc<Prefiltered>, Kernel),
    /// A pattern's parts.
    Parts(Arc<Channel>),
    /// A pattern's texels, and sums by which they are drawn.
    Cells(Arc<Channel>),
    /// Angles γ, planes C and shares of measured intensities.
    Web(Arc<Distribution>),
}

impl PartialEq for Table {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::None, Self::None) => true,
            (Self::Pattern(a, a_kernel), Self::Pattern(b, b_kernel)) => Arc::ptr_eq(a, b) && a_kernel == b_kernel,
            (Self::Web(a), Self::Web(b)) => Arc::ptr_eq(a, b),
            (Self::Parts(a), Self::Parts(b)) | (Self::Cells(a), Self::Cells(b)) => Arc::ptr_eq(a, b),
            _ => false,
        }
    }
}

impl Table {
    /// What it holds.
    pub(crate) fn numbers(&self) -> Vec<f32> {
        match self {
            Self::None => vec![0.0],
            Self::Parts(channel) => textured::parts(channel),
            Self::Cells(channel) => cells::cells(channel),
            Self::Web(web) => {
                let numbers = [web.gammas(), web.planes(), web.shares()].into_iter().flatten();
                numbers.copied().map(f32_of).collect()
            }
            Self::Pattern(pattern, Kernel::Disk) => pattern.disks().sums().iter().copied().map(f32_of).collect(),
            Self::Pattern(pattern, Kernel::Square) => {
                pattern.mipmap().levels().iter().flatten().copied().map(f32_of).collect()
            }
        }
    }
}
