//! `softbox export --to ies`, and the file used as a light.

use std::fs;

use super::{WINDOW, check_done, folder, names, run, shown, text};

#[test]
fn a_windows_file_lights_a_floor_as_the_window_does_far_away() {
    let folder = folder();
    let output = folder.path().join("window.ies");
    let exported = run(&["export", WINDOW, "-o", shown(&output), "--light", "window"]);
    check_done(&exported);
    assert!(text(&exported.stderr).contains("within 1 % from"), "{}", text(&exported.stderr));
    let matt = "[[material]]\nname = \"matt\"\ndiffuse = [1.0, 1.0, 1.0]\nspecular = [0.0, 0.0, 0.0]\nexponent = 1.0\n";
    let scene =
        |light: &str| format!("format = 1\n{matt}[[light]]\nname = \"a\"\nposition = [0.0, 0.0, 60.0]\n{light}\n");
    let window = "luminance = 1000.0\n\
                  shape = { polygon = { vertices = [[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]] } }";
    fs::write(folder.path().join("near.toml"), scene(window)).expect("the folder is writable");
    let candela = "intensity = 2000.0\nshape = { point = { ies = \"window.ies\" } }";
    fs::write(folder.path().join("far.toml"), scene(candela)).expect("the folder is writable");
    let points = folder.path().join("points.csv");
    let rows = "x,y,z,nx,ny,nz,vx,vy,vz\n0,0,0,0,0,1,0,0,1\n30,10,0,0,0,1,0,0,1\n-20,50,3,0.6,0,0.8,0,0,1\n";
    fs::write(&points, rows).expect("the folder is writable");
    let illuminances = |scene: &str| -> Vec<f64> {
        let probed = run(&["probe", shown(&folder.path().join(scene)), "--points", shown(&points)]);
        check_done(&probed);
        let lines = text(&probed.stdout).lines().skip(1).map(str::to_owned).collect::<Vec<_>>();
        lines.iter().map(|line| line.split(',').nth(4).and_then(|n| n.parse().ok()).expect("an illuminance")).collect()
    };
    let (near, far) = (illuminances("near.toml"), illuminances("far.toml"));
    assert_eq!(near.len(), 3, "three points");
    for (near, far) in near.iter().zip(&far) {
        // 9.5e-4 of the peak by interpolation, 6e-4 by the distance.
        assert!((far / near - 1.0).abs() < 2e-3, "{far} lx of the file, {near} lx of the window");
    }
}

#[test]
fn what_has_no_candela_is_refused_unless_that_is_allowed() {
    let folder = folder();
    let output = folder.path().join("everything.ies");
    let arguments = ["export", "tests/data/everything.toml", "-o", shown(&output)];
    let refused = run(&arguments);
    assert_eq!(refused.status.code(), Some(2), "{}", text(&refused.stderr));
    assert!(text(&refused.stderr).contains("lost     light \"moon\""), "{}", text(&refused.stderr));
    assert!(names(folder.path()).is_empty(), "something is written");
    check_done(&run(&[&arguments[..], &["--allow-loss"]].concat()));
    assert_eq!(names(folder.path()), [output], "one file");
}
