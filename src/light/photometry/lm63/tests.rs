//! Files of each version, and bad ones.

use glam::DVec3;

use super::*;

/// A file of 2002 with those horizontal angles and rows of candela at γ = 0, 45 and 90.
fn file(planes: &str, candela: &str) -> String {
    let count = planes.split_whitespace().count();
    format!(
        "IESNA:LM-63-2002\r\n[TEST] none\r\nTILT=NONE\r\n1 1000 2 3 {count} 1 2 -0.1 -0.1 0\r\n1 1 10\r\n0 45 90\r\n\
         {planes}\r\n{candela}\r\n"
    )
}

fn candela(text: &str, (c, gamma): (f64, f64)) -> f64 {
    let distribution = read(text.as_bytes()).unwrap_or_else(|wrong| panic!("it is read, but{wrong}"));
    distribution.peak() * distribution.share_at(c.to_radians(), gamma.to_radians())
}

#[track_caller]
fn check(text: &str, at: (f64, f64), expected: f64) {
    let got = candela(text, at);
    assert!((got - expected).abs() < 1e-12 * expected.max(1.0), "{got} cd at {at:?}, not {expected}");
}

#[track_caller]
fn refused(text: &str, words: &str) {
    let wrong = read(text.as_bytes()).expect_err("it is refused");
    assert!(wrong.contains(words), "`{wrong}` does not say `{words}`");
    assert!(!wrong.contains('\n'), "one line: {wrong}");
}

#[test]
fn all_versions_are_read_with_their_factors() {
    let body = "TILT=NONE\n1 1000 2 2 1 1 1 0 0 0 0.5 0.8 10\n0, 180\n0\n100 100\n";
    for (header, expected) in [
        ("A LAMP\nof 1986\n", 80.0),
        ("IESNA91\n[TEST] 1\n", 80.0),
        ("IESNA:LM-63-1995\n[TEST] 1\n", 100.0),
        ("IESNA:LM-63-2002\n[TEST] 1\n[MORE] TILT is no line of its own here\n", 100.0),
        ("IES:LM-63-2019\n", 100.0),
    ] {
        check(&format!("{header}{body}"), (0.0, 90.0), expected);
    }
    refused(&format!("IESNA:LM-63-2040\n{body}"), "line 1: `IESNA:LM-63-2040` is no version");
}

#[test]
fn planes_are_completed_by_the_symmetry_that_their_angles_tell() {
    let quadrant = file("0 90", "1 2 3 1 4 5");
    for c in [0.0, 180.0, 360.0] {
        check(&quadrant, (c, 45.0), 4.0);
    }
    check(&quadrant, (90.0, 90.0), 10.0);
    check(&quadrant, (270.0, 90.0), 10.0);
    check(&quadrant, (225.0, 45.0), 6.0);
    let bilateral = file("0 90 180", "1 2 3 1 4 5 1 6 7");
    check(&bilateral, (270.0, 45.0), 8.0);
    check(&bilateral, (180.0, 45.0), 12.0);
    let across = file("90 180 270", "1 2 3 1 4 5 1 6 7");
    check(&across, (0.0, 45.0), 8.0);
    check(&across, (90.0, 45.0), 4.0);
    check(&across, (315.0, 45.0), 10.0);
    let across = file("90 150 270", "1 2 3 1 4 5 1 6 7");
    check(&across, (30.0, 45.0), 8.0);
    check(&across, (150.0, 45.0), 8.0);
    check(&across, (0.0, 45.0), 9.0);
    check(&across, (180.0, 45.0), 9.0);
    let all = file("0 90 180 270 360", "1 2 3 1 4 5 1 6 7 1 8 9 1 2 3");
    check(&all, (315.0, 45.0), 10.0);
    let open = file("0 90 180 270", "1 2 3 1 4 5 1 6 7 1 8 9");
    check(&open, (315.0, 45.0), 10.0);
    check(&file("0", "1 2 3"), (123.0, 22.5), 3.0);
}

#[test]
fn a_tilted_lamp_has_the_factor_of_a_luminaire_that_hangs_level() {
    let text = file("0", "1 2 3").replace("TILT=NONE", "TILT=INCLUDE\n1\n3\n0 45 90\n0.95 0.9 0.8");
    check(&text, (0.0, 45.0), 3.8);
    check(&text.replace("0 45 90\n0.95", "-45 45 90\n0.8"), (0.0, 45.0), 3.4);
    refused(&text.replace("0.95 0.9", "0 0.9"), "the tilt factor at 0 is 0");
    refused(&text.replace("TILT=INCLUDE", "TILT=LAMP.TLT"), "line 3: TILT=LAMP.TLT names another file");
}

/// A file of type A or B with angles from −90 or 0, five degrees apart, whose candela are a function of V and H.
fn sphere(kind: usize, from: i32, candela: impl Fn(f64, f64) -> f64) -> String {
    let angles = |from: i32| (from..=90).step_by(5).map(f64::from).collect::<Vec<_>>();
    let (vertical, horizontal) = (angles(-90), angles(from));
    let line = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
    let rows = horizontal.iter().map(|h| line(&vertical.iter().map(|v| candela(*v, *h)).collect::<Vec<_>>()));
    let rows: Vec<_> = rows.collect();
    format!(
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {} {} {kind} 2 0 0 0\n1 1 0\n{}\n{}\n{}\n",
        vertical.len(),
        horizontal.len(),
        line(&vertical),
        line(&horizontal),
        rows.join("\n")
    )
}

#[test]
fn types_a_and_b_become_type_c() {
    let cosine = |v: f64, h: f64| 100.0 * (v.to_radians().cos() * h.to_radians().cos());
    for kind in [2, 3] {
        for from in [-90, 0] {
            // In both, cos V cos H is the cosine from the beam.
            let text = sphere(kind, from, cosine);
            for (c, gamma) in [(0.0, 0.0), (0.0, 50.0), (33.0, 61.5), (212.0, 20.0), (270.0, 90.0)] {
                let (found, expected) = (candela(&text, (c, gamma)), 100.0 * gamma.to_radians().cos());
                assert!((found - expected).abs() < 0.3, "type {kind}: {found} cd at {c}, {gamma}, not {expected}");
            }
            let flux = read(text.as_bytes()).expect("a file").flux_per_peak();
            assert!((flux / std::f64::consts::PI - 1.0).abs() < 3e-3, "{flux} sr");
        }
        // Right of the beam and up, +X and +Y; on these axes both types agree.
        let text = sphere(kind, -90, |v, h| 500.0 + v + 2.0 * h);
        for (c, gamma, expected) in
            [(0.0, 40.0, 580.0), (180.0, 40.0, 420.0), (90.0, 40.0, 540.0), (270.0, 40.0, 460.0)]
        {
            check(&text, (c, gamma), expected);
        }
        check(&text, (0.0, 120.0), 0.0);
    }
    // Off the axes: type A has V as the latitude, type B has H.
    let towards = DVec3::new(0.5, 0.6, -0.7).normalize();
    for (kind, v, h) in [(2, 0.6_f64.atan2(0.7), towards.x.asin()), (3, towards.y.asin(), 0.5_f64.atan2(0.7))] {
        let text = sphere(kind, -90, |v, h| 500.0 + v + 2.0 * h);
        let distribution = read(text.as_bytes()).expect("a file");
        let (found, expected) =
            (distribution.peak() * distribution.share(towards), 500.0 + v.to_degrees() + 2.0 * h.to_degrees());
        assert!((found - expected).abs() < 0.05, "type {kind}: {found} cd, not {expected}");
    }
}

#[test]
fn c_0_is_on_the_side_of_x_and_c_90_of_y() {
    let text = file("0 90 180 270 360", "1 2 3 1 4 5 1 6 7 1 8 9 1 2 3");
    let distribution = read(text.as_bytes()).expect("a file");
    let candela = |x: f64, y: f64| distribution.peak() * distribution.share(DVec3::new(x, y, -1.0));
    let got = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| candela(x, y));
    for (got, expected) in got.into_iter().zip([4.0, 8.0, 12.0, 16.0]) {
        assert!((got - expected).abs() < 1e-12, "{got} cd, not {expected}");
    }
}

#[test]
fn a_bad_file_is_told_in_one_line_with_the_line_number() {
    let good = file("0", "1 2 3");
    refused("", "no line TILT=");
    refused("<html>", "no line TILT=");
    refused(&good.replace("0 45 90", "0 45 x"), ", line 6: `x` is no number; here stands vertical angles 3 of 3");
    refused(&good.replace("0 45 90", "0 95 90"), ", line 6: vertical angles must increase, but 90 follows 95");
    refused(&good.replace("0 45 90", "0 45 190"), ", line 6: vertical angles of type C");
    refused(&good.replace("1 2 3\r", "1 -2 3\r"), ", line 8: candela 2 of 3 is -2");
    refused(&good.replace("1 2 3\r\n", "1 2"), ", line 8: the file ends before candela 3 of 3");
    refused(&good.replace("1 2 3\r", "1 2 3 4\r"), ", line 8: more than the angles ask for");
    refused(&good.replace("1 2 3\r", "0 0 0\r"), "gives no light");
    refused(&good.replace("2 3 1 1 2", "2 3 1 2 2"), ", line 7: horizontal angles of type B are two or more");
    refused(
        &good.replace("2 3 1 1 2", "2 3 1 3 2").replace("0 45 90", "0 45 95"),
        ", line 6: vertical angles of type A",
    );
    refused(&good.replace("2 3 1 1 2", "2 3 1 4 2"), ", line 4: the photometric type is 4");
    refused(&good.replace("2 3 1 1 2", "2 3.5 1 1 2"), ", line 4: the number of vertical angles is 3.5");
    refused(&good.replace("2 3 1 1 2", "2 1 1 1 2"), ", line 4: there is one vertical angle");
    refused(&good.replace("2 3 1 1 2", "2 3000 3000 1 2"), ", line 4: more than 1000000 intensities");
    refused(&good.replace("2 3 1 1 2", "0 3 1 1 2"), ", line 4: the candela multiplier is 0; write 1");
    refused(&good.replace("1000 2 3", "1000 inf 3"), ", line 4: `inf` is no number");
    refused(&file("0 45", "1 2 3 1 2 3"), ", line 7: horizontal angles from 0 to 45");
    refused(&file("10 350", "1 2 3 1 2 3"), ", line 7: horizontal angles from 10 to 350");
}

#[test]
fn what_comes_from_anywhere_never_panics() {
    let good = file("0 90", "1 2 3 1 4 5");
    for cut in 0..good.len() {
        let _ = read(&good.as_bytes()[..cut]);
        let mut changed = good.clone().into_bytes();
        for byte in [b'-', b'9', 0xff, 0] {
            changed[cut] = byte;
            if let Ok(distribution) = read(&changed) {
                let flux = distribution.flux_per_peak();
                assert!(flux.is_finite() && flux >= 0.0, "{flux} sr with byte {cut} as {byte}");
            }
        }
    }
}
