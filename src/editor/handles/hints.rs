//! What the status line says of handles.

use super::Handle;
use super::readout::AXES;

/// What dragging a handle would do.
pub(super) fn of_handle(handle: Handle) -> String {
    let text = match handle {
        Handle::Axis(axis) => return format!("Drag to move along {}", AXES[axis]),
        Handle::Plane(normal) => {
            return format!("Drag to move in the plane of {} and {}", AXES[(normal + 1) % 3], AXES[(normal + 2) % 3]);
        }
        Handle::Ring(axis) => return format!("Drag to rotate about {}; Ctrl snaps to 15°", AXES[axis]),
        Handle::Stretch(axis) => return format!("Drag to stretch along {}; Ctrl snaps to tenths", AXES[axis]),
        Handle::Screen => "Drag to move across the screen",
        Handle::ScreenRing => "Drag to rotate about the line of sight; Ctrl snaps to 15°",
        Handle::Scale => "Drag right or up to scale; Ctrl snaps to tenths",
        Handle::Vertex(_) => "Drag to move this vertex; click to choose it, then Delete takes it away",
        Handle::Edge(_) => "Drag to move this edge; click to add a vertex here, Alt+click anywhere on the edge",
        Handle::End(_) => "Drag to move this end",
        Handle::Side([_, _, 0]) => "Drag to move this side or corner",
        Handle::Side(_) => "Drag to move this face",
        Handle::Radius => "Drag to change the radius",
        Handle::HalfAngle => "Drag to change the half-angle; Ctrl snaps to 5°",
        Handle::Control(_) => "Drag to move this control point across the screen",
        Handle::Aim => "Drag to where the light comes from; Ctrl snaps to 15°",
        Handle::Target => "Drag to what the light shall face",
        Handle::Probe => "Drag the probe over surfaces or in the air; Ctrl keeps its normal",
        Handle::Normal => "Drag to turn the probe's normal; Ctrl snaps to 15°",
    };
    text.to_owned()
}

/// What else can be done while a handle is held; `grid` in metres.
pub(super) fn while_held(handle: Handle, grid: f64) -> String {
    let snaps = match handle {
        Handle::Ring(_) | Handle::ScreenRing | Handle::Aim | Handle::Normal => "Ctrl snaps to 15°".to_owned(),
        Handle::Stretch(_) | Handle::Scale => "Ctrl snaps to tenths".to_owned(),
        Handle::HalfAngle => "Ctrl snaps to 5°".to_owned(),
        Handle::Probe => "Ctrl keeps the normal".to_owned(),
        Handle::Vertex(_) | Handle::End(_) => format!("Ctrl snaps to corners and {grid} m"),
        _ => format!("Ctrl snaps to {grid} m"),
    };
    let typed = if takes_numbers(handle) { "; type a number, Enter sets it" } else { "" };
    format!("{snaps}; Shift drags fine{typed}; Esc cancels")
}

/// Whether numbers typed while it is held mean anything.
fn takes_numbers(handle: Handle) -> bool {
    !matches!(
        handle,
        Handle::Aim | Handle::Target | Handle::Probe | Handle::Normal | Handle::Vertex(_) | Handle::Edge(_)
    )
}
