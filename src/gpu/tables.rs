//! Tables on a device, shared by the lights and the frames that have them.

use super::pass;
use super::table::Table;

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
