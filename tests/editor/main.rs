//! The editor as a user sees it: widgets are found by their labels, clicked, dragged and typed into; then the document
//! is looked at.

mod comfort;
mod draw;
mod export;
mod files;
mod gestures;
mod handles;
mod library;
mod list;
mod paint;
mod panes;
mod plots;
mod problems;
mod safety;
mod shapes;
mod start;
mod viewport;
mod views;
mod window;
