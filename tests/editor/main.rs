//! The editor as a user sees it: widgets are found by their labels, clicked, dragged and typed into; then the document
//! is looked at.

mod draw;
mod files;
mod list;
mod panes;
mod shapes;
mod start;
mod viewport;
mod views;
mod window;
