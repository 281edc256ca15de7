//! The editor as a user sees it: widgets are found by their labels, clicked, dragged and typed into; then the document
//! is looked at.

mod comfort;
mod draw;
mod files;
mod list;
mod gestures;
mod library;
mod panes;
mod safety;
mod shapes;
mod start;
mod viewport;
mod window;
