//! Large tables that layers read, shared by the lights and the frames that have them.

use std::sync::Arc;

use super::types::f32_of;
use super::{pass, shadows, textured};
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
            Self::Cells(channel) => shadows::cells(channel),
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

/// Tables that are kept on the device.
const KEPT: usize = 16;

/// The tables that layers used last, on a device.
#[derive(Debug, Default)]
pub(crate) struct Tables(Vec<(Table, wgpu::Buffer)>);

impl Tables {
    /// The buffer of a table, made where it is not kept.
    pub(crate) fn buffer(&mut self, device: &wgpu::Device, table: &Table) -> wgpu::Buffer {
        let entry = match self.0.iter().position(|(kept, _)| kept == table) {
            Some(i) => self.0.remove(i),
            None => (table.clone(), pass::storage(device, &table.numbers())),
        };
        let buffer = entry.1.clone();
        self.0.push(entry);
        let excess = self.0.len().saturating_sub(KEPT);
        self.0.drain(..excess);
        buffer
    }
}
