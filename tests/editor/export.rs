//! The export dialog: what a target would lose is said before anything is written.

use egui::{Key, Modifiers};
use egui_kittest::kittest::NodeT;

use crate::window::Window;

#[test]
fn a_scene_is_exported_after_it_is_said_what_becomes_of_each_thing() {
    let mut window = Window::with_scene();
    window.click("Mute strip");
    window.menu(&["Add", "Light", "Directional"]);
    window.menu(&["File", "Export…"]);
    window.menu(&["Export target", "JSON: the scene, for scripts"]);
    assert!(window.says("0 lost; 1 file"), "all is said");
    assert!(window.says("is muted and left out"), "the muted light, too");
    let (json, ies) = (window.path("out.json"), window.path("out.ies"));
    let out = window.path("out");
    window.choose(Some(&out));
    window.click("Write export");
    assert!(window.says(&format!("Exported {}", json.display())), "it is told where it is");
    let text = std::fs::read_to_string(&json).expect("the file is there");
    assert!(text.contains("\"globe\"") && text.contains("\"ball\"") && !text.contains("\"strip\""), "{text}");

    window.menu(&["File", "Export…"]);
    window.menu(&["Export target", "IES"]);
    assert!(window.says("1 lost; 1 file"), "parallel light has no place");
    let is_off = |window: &Window| window.get("Write export").accesskit_node().is_disabled();
    assert!(is_off(&window), "nothing is lost unasked");
    window.snapshot("export");
    window.click("Export anyway");
    assert!(!is_off(&window), "asked");
    window.choose(Some(&ies));
    window.click("Write export");
    assert!(std::fs::read_to_string(&ies).is_ok_and(|text| text.starts_with("IESNA")), "the file is there");

    window.get("globe").click_secondary();
    window.settle();
    window.click("Export selected lights…");
    assert!(window.says("light \"globe\"") && !window.says("light \"window\""), "the selected light alone");
    window.click("Export window");
    assert!(window.says("light \"window\""), "now it is ticked, too");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.has("Write export"), "put away");
    assert_eq!(window.steps_back(), ["Add directional", "Mute"], "the document has no part in it");
}
