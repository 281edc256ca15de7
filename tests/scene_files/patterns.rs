//! Pattern files: what they become, what is refused and how, and that they go along with a scene.

use std::fs;
use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;

use image::{DynamicImage, ImageBuffer, ImageFormat, Luma, LumaA, Rgb, Rgba};
use proptest::prelude::*;
use softbox::light::Shape;
use softbox::light::pattern::{Image, Pattern};
use softbox::scene::{self, Scene};

use super::{SHAPE, names, with};

/// A light's shape with a pattern of that name.
fn shape(name: &str) -> String {
    format!("textured = {{ size = [1.0, 1.0], pattern = \"{name}\" }}")
}

/// The window scene, its light with a pattern.
fn text(name: &str) -> String {
    with(SHAPE, &shape(name))
}

/// A new folder of files.
fn folder(files: &[(&str, &[u8])]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, bytes) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a file is in a folder")).expect("the folder is writable");
        fs::write(path, bytes).expect("the folder is writable");
    }
    folder
}

fn encoded(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    picture.into().write_to(&mut Cursor::new(&mut bytes), format).expect("the picture has this format");
    bytes
}

/// A grey PNG of that size.
fn grey(width: u32, height: u32, value: u8) -> Vec<u8> {
    encoded(ImageBuffer::from_pixel(width, height, Luma([value])), ImageFormat::Png)
}

#[track_caller]
fn load(folder: &Path) -> Scene {
    scene::load(folder.join("window.toml")).unwrap_or_else(|error| panic!("{error}"))
}

fn pattern(scene: &Scene, light: usize) -> &Pattern {
    let Shape::Textured(textured) = &scene.lights[light].shape else { panic!("a textured light") };
    &textured.pattern
}

/// The image that a file becomes.
#[track_caller]
fn image(bytes: &[u8]) -> Image {
    let read = scene::parse_with(&text("leaf.png"), "window.toml", |_| Ok(bytes.to_vec()));
    pattern(&read.unwrap_or_else(|error| panic!("{error}")), 0).image.clone()
}

/// What is said of a file; what comes before its name is left out.
#[track_caller]
fn refusal(bytes: &[u8]) -> String {
    let read = scene::parse_with(&text("leaf.png"), "window.toml", |_| Ok(bytes.to_vec()));
    let message = read.expect_err("this must be refused").to_string();
    assert_eq!(message.lines().count(), 1, "one line: {message}");
    let place = "window.toml:27:53: light[0].shape.textured.pattern: `leaf.png` ";
    message.strip_prefix(place).unwrap_or_else(|| panic!("`{message}` starts otherwise")).to_owned()
}

#[track_caller]
fn check(image: &Image, expected: &[&[f64]]) {
    assert_eq!(image.channels().len(), expected.len(), "channels");
    for (channel, expected) in image.channels().iter().zip(expected) {
        let texels: Vec<f64> = channel.texels().iter().map(|texel| f64::from(*texel)).collect();
        assert_eq!(texels.len(), expected.len(), "{texels:?}");
        let near = texels.iter().zip(*expected).all(|(texel, expected)| (texel - expected).abs() <= 1e-6);
        assert!(near, "{texels:?} is not {expected:?}");
    }
}

/// sRGB codes 0.2 and 0.6, decoded.
const DARK: f64 = 0.033_104_766_570_885_055;
const MIDDLE: f64 = 0.318_546_778_125_092_6;

#[test]
fn integers_are_srgb_and_alpha_multiplies() {
    let png = |picture: DynamicImage| image(&encoded(picture, ImageFormat::Png));
    let texels = ImageBuffer::from_raw(2, 2, vec![0_u8, 51, 153, 255]).expect("four texels");
    check(&png(DynamicImage::ImageLuma8(texels)), &[&[0.0, DARK, MIDDLE, 1.0]]);
    let wide = ImageBuffer::from_raw(2, 1, vec![13107_u16, 39321]).expect("two texels");
    check(&png(DynamicImage::ImageLuma16(wide)), &[&[DARK, MIDDLE]]);
    check(&png(ImageBuffer::from_pixel(1, 1, LumaA([153_u8, 51])).into()), &[&[0.2 * MIDDLE]]);
    check(&png(ImageBuffer::from_pixel(1, 1, LumaA([39321_u16, 13107])).into()), &[&[0.2 * MIDDLE]]);
    check(&png(ImageBuffer::from_pixel(1, 1, Rgb([255_u8, 51, 0])).into()), &[&[1.0], &[DARK], &[0.0]]);
    check(&png(ImageBuffer::from_pixel(1, 1, Rgba([255_u8, 51, 0, 51])).into()), &[&[0.2], &[0.2 * DARK], &[0.0]]);
    check(
        &png(ImageBuffer::from_pixel(1, 1, Rgba([65535_u16, 13107, 0, 13107])).into()),
        &[&[0.2], &[0.2 * DARK], &[0.0]],
    );
    check(&png(ImageBuffer::from_pixel(2, 1, Rgb([51_u8, 51, 51])).into()), &[&[DARK, DARK]]);
    let jpeg = encoded(ImageBuffer::from_pixel(8, 8, Luma([153_u8])), ImageFormat::Jpeg);
    check(&image(&jpeg), &[&[MIDDLE; 64]]);
}

#[test]
fn floating_point_is_linear_and_holds_its_alpha() {
    let hdr = encoded(ImageBuffer::from_pixel(9, 1, Rgb([4.0_f32, 0.5, 0.25])), ImageFormat::Hdr);
    check(&image(&hdr), &[&[4.0; 9], &[0.5; 9], &[0.25; 9]]);
    let exr = encoded(ImageBuffer::from_pixel(1, 1, Rgb([1e6_f32, 0.5, 0.25])), ImageFormat::OpenExr);
    check(&image(&exr), &[&[1e6], &[0.5], &[0.25]]);
    let premultiplied = encoded(ImageBuffer::from_pixel(1, 1, Rgba([0.5_f32, 0.5, 0.5, 0.5])), ImageFormat::OpenExr);
    check(&image(&premultiplied), &[&[0.5]]);
}

#[test]
fn the_largest_pattern_loads_and_one_texel_more_does_not() {
    assert_eq!(image(&grey(4096, 4096, 255)).channels()[0].texels().len(), 1 << 24, "all texels");
    insta::assert_snapshot!(refusal(&grey(4097, 1, 255)), @"is 4097 x 1 texels; scale it to at most 4096 x 4096");
}

/// A PNG whose header claims a size, its checksum right.
fn claiming(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = grey(1, 1, 255);
    bytes[16..20].copy_from_slice(&width.to_be_bytes());
    bytes[20..24].copy_from_slice(&height.to_be_bytes());
    let sum = crc32(&bytes[12..29]);
    bytes[29..33].copy_from_slice(&sum.to_be_bytes());
    bytes
}

/// The checksum of PNG's chunks.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0, |sum, byte| {
        (0..8).fold(sum ^ u32::from(*byte), |sum, _| (sum >> 1) ^ if sum & 1 == 1 { 0xedb8_8320 } else { 0 })
    })
}

#[test]
fn hostile_pictures_are_refused_in_one_line() {
    insta::assert_snapshot!(refusal(b""), @"is no PNG, JPEG, EXR or HDR picture; save it as one of these");
    insta::assert_snapshot!(refusal(b"format = 1"), @"is no PNG, JPEG, EXR or HDR picture; save it as one of these");
    insta::assert_snapshot!(refusal(b"GIF89a\x01\x00\x01\x00"), @"is no PNG, JPEG, EXR or HDR picture; save it as one of these");
    insta::assert_snapshot!(refusal(&grey(5, 3, 0)), @"is black all over; give it at least one texel that shines");
    insta::assert_snapshot!(refusal(&claiming(0x7fff_ffff, 0x7fff_ffff)), @"cannot be decoded: Memory limit exceeded; save it anew as PNG, JPEG, EXR or HDR");
    insta::assert_snapshot!(refusal(&claiming(4096, 4096)), @"cannot be decoded: Format error decoding Png: IDAT or fDAT chunk does not have enough data for image.; save it anew as PNG, JPEG, EXR or HDR");
    insta::assert_snapshot!(refusal(&claiming(0, 1)), @"cannot be decoded: Format error decoding Png: Invalid image dimensions; save it anew as PNG, JPEG, EXR or HDR");
    insta::assert_snapshot!(refusal(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2000000000 +X 2000000000\n"), @"is 2000000000 x 2000000000 texels; scale it to at most 4096 x 4096");
    insta::assert_snapshot!(refusal(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4096 +X 4096\n"), @"cannot be decoded: failed to fill whole buffer; save it anew as PNG, JPEG, EXR or HDR");
    for (what, value) in [("NaN", f32::NAN), ("-1", -1.0), ("inf", f32::INFINITY)] {
        let mut picture = ImageBuffer::from_pixel(3, 2, Rgb([1.0_f32, 0.5, 0.5]));
        picture.get_pixel_mut(2, 1)[1] = value;
        let expected = format!("has {what} as green in row 1, column 2; texels must be finite and not negative");
        assert_eq!(refusal(&encoded(picture, ImageFormat::OpenExr)), expected, "a texel of {value}");
    }
}

#[test]
fn truncated_pictures_are_refused() {
    let noise =
        ImageBuffer::from_fn(32, 32, |x, y| Rgb([(x * y * 37 % 251) as u8, (x * 91 % 253) as u8, (y % 32) as u8]));
    let noise = DynamicImage::ImageRgb8(noise);
    for format in [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::OpenExr, ImageFormat::Hdr] {
        let picture = match format {
            ImageFormat::OpenExr | ImageFormat::Hdr => DynamicImage::ImageRgb32F(noise.to_rgb32f()),
            _ => noise.clone(),
        };
        let bytes = encoded(picture, format);
        image(&bytes);
        let message = refusal(&bytes[..bytes.len() / 2]);
        assert!(message.starts_with("cannot be decoded: "), "{format:?}: {message}");
    }
}

/// An EXR file of one part whose data window is `width` wide.
fn wide_exr(width: i32) -> Vec<u8> {
    let mut bytes = encoded(ImageBuffer::from_pixel(4, 4, Rgb([1.0_f32, 0.5, 0.25])), ImageFormat::OpenExr);
    let name = b"dataWindow\0box2i\0";
    let at = bytes.windows(name.len()).position(|window| window == name).expect("an EXR file has a data window");
    let right = at + name.len() + 4 + 8;
    bytes[right..right + 4].copy_from_slice(&(width - 1).to_le_bytes());
    bytes
}

#[test]
fn an_exr_whose_data_are_larger_than_its_picture_is_refused_unread() {
    insta::assert_snapshot!(refusal(&wide_exr(1_000_000_000)), @"is 1000000000 x 4 texels; scale it to at most 4096 x 4096");
}

#[test]
fn the_texels_of_a_scene_are_limited_together() {
    let light = |i: usize| {
        format!("\n[[light]]\nname = \"more {i}\"\nluminance = 1.0\nshape = {{ {} }}\n", shape(&format!("{i}.png")))
    };
    let text = text("leaf.png") + &(0..4).map(light).collect::<String>();
    let largest = grey(4096, 4096, 255);
    let error = scene::parse_with(&text, "window.toml", |_| Ok(largest.clone())).expect_err("five are too many");
    insta::assert_snapshot!(error, @"window.toml:47:53: light[4].shape.textured.pattern: `3.png` is too much: a scene's patterns have at most 67108864 texels; scale some down");
}

#[test]
fn a_file_that_several_lights_name_is_read_once() {
    let second = format!("\n[[light]]\nname = \"second\"\nluminance = 1.0\nshape = {{ {} }}\n", shape("leaf.png"));
    let mut reads = 0;
    let scene = scene::parse_with(&(text("leaf.png") + &second), "window.toml", |_| {
        reads += 1;
        Ok(grey(2, 2, 99))
    });
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    let [first, second] = [0, 1].map(|light| pattern(&scene, light));
    assert_eq!(reads, 1, "reads");
    assert!(Arc::ptr_eq(&first.image.channels()[0], &second.image.channels()[0]), "texels are shared");
    assert!(Arc::ptr_eq(&first.contents.0, &second.contents.0), "contents are shared");
}

/// What is said when the scene with a pattern is loaded from a folder.
#[track_caller]
fn folder_refusal(name: &str, make: impl FnOnce(&Path)) -> String {
    let folder = folder(&[("window.toml", text(name).as_bytes())]);
    make(&folder.path().join(name));
    let error = scene::load(folder.path().join("window.toml")).expect_err("this must be refused").to_string();
    error.replace(&format!("{}/", folder.path().display()), "")
}

#[test]
fn files_that_cannot_be_patterns_are_refused_unread() {
    insta::assert_snapshot!(folder_refusal("absent.png", |_| {}), @"window.toml:27:53: light[0].shape.textured.pattern: `absent.png` cannot be read: No such file or directory (os error 2); write the name of a PNG, JPEG, EXR or HDR file in the scene's folder");
    insta::assert_snapshot!(folder_refusal("folder.png", |path| fs::create_dir(path).unwrap()), @"window.toml:27:53: light[0].shape.textured.pattern: `folder.png` cannot be read: it is a directory; write the name of a PNG, JPEG, EXR or HDR file in the scene's folder");
    insta::assert_snapshot!(
        folder_refusal("huge.png", |path| fs::File::create(path).unwrap().set_len(1 << 40).unwrap()), @"window.toml:27:53: light[0].shape.textured.pattern: `huge.png` cannot be read: it is larger than 320 MiB; write the name of a PNG, JPEG, EXR or HDR file in the scene's folder");
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out_of_the_folder() {
    use std::os::unix::fs::symlink;
    let outside = folder(&[("secret.png", &grey(1, 1, 255))]);
    let secret = outside.path().join("secret.png");
    insta::assert_snapshot!(folder_refusal("link.png", |path| symlink(&secret, path).unwrap()), @"window.toml:27:53: light[0].shape.textured.pattern: `link.png` cannot be read: a link leads out of the scene's folder; write the name of a PNG, JPEG, EXR or HDR file in the scene's folder");
    insta::assert_snapshot!(folder_refusal("null.png", |path| symlink("/dev/zero", path).unwrap()), @"window.toml:27:53: light[0].shape.textured.pattern: `null.png` cannot be read: a link leads out of the scene's folder; write the name of a PNG, JPEG, EXR or HDR file in the scene's folder");
    let inside = folder(&[("window.toml", text("link.png").as_bytes()), ("leaf.png", &grey(1, 1, 255))]);
    symlink("leaf.png", inside.path().join("link.png")).expect("the folder is writable");
    load(inside.path());

    let source =
        folder(&[("window.toml", text("textures/leaf.png").as_bytes()), ("textures/leaf.png", &grey(1, 1, 9))]);
    let target = folder(&[]);
    symlink(outside.path(), target.path().join("textures")).expect("the folder is writable");
    scene::save(&load(source.path()), target.path().join("window.toml")).expect_err("the pattern would be outside");
    assert_eq!(names(outside.path()), ["secret.png"], "nothing was written there");
}

#[test]
fn all_problems_are_told_at_once() {
    let second = format!("\n[[light]]\nname = \"second\"\nluminance = -1.0\nshape = {{ {} }}\n", shape("black.png"));
    let error = scene::parse_with(&(text("large.png") + &second), "window.toml", |name| {
        Ok(if name == "black.png" { grey(1, 1, 0) } else { grey(5000, 1, 9) })
    });
    insta::assert_snapshot!(error.expect_err("two patterns and a number are wrong"), @r"
window.toml:27:53: light[0].shape.textured.pattern: `large.png` is 5000 x 1 texels; scale it to at most 4096 x 4096
window.toml:31:13: light[1].luminance: must not be negative, but is -1.0; write a number such as 1000.0
window.toml:32:53: light[1].shape.textured.pattern: `black.png` is black all over; give it at least one texel that shines
");
}

#[test]
fn patterns_go_along_when_a_scene_is_saved_elsewhere() {
    let leaf = grey(3, 2, 77);
    let source = folder(&[("window.toml", text("textures/leaf.png").as_bytes()), ("textures/leaf.png", &leaf)]);
    let scene = load(source.path());
    let target = tempfile::tempdir().expect("a temporary folder");
    let file = target.path().join("window.toml");
    fs::remove_dir_all(source.path().join("textures")).expect("nothing depends on the old files");
    scene::save_as(&scene, &file, source.path().join("window.toml")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(load(target.path()), scene, "the same scene");
    assert_eq!(fs::read(target.path().join("textures/leaf.png")).expect("it is there"), leaf, "the same file");
    assert_eq!(names(target.path()), ["textures", "window.toml"], "and nothing else");
    scene::save(&scene, &file).unwrap_or_else(|error| panic!("again: {error}"));
}

#[test]
fn another_file_of_a_patterns_name_is_not_replaced() {
    let source = folder(&[("window.toml", text("leaf.png").as_bytes()), ("leaf.png", &grey(3, 2, 77))]);
    let target = folder(&[("leaf.png", b"something else")]);
    let file = target.path().join("window.toml");
    let error = scene::save(&load(source.path()), &file).expect_err("the names collide").to_string();
    insta::assert_snapshot!(error.replace(&format!("{}/", target.path().display()), ""), @"window.toml: not saved, as its pattern leaf.png cannot be: there is another file of that name; rename one of the two");
    assert_eq!(names(target.path()), ["leaf.png"], "nothing was saved");
    assert_eq!(fs::read(target.path().join("leaf.png")).expect("it is there"), b"something else", "nothing is lost");
}

#[test]
fn lights_of_different_pictures_of_one_name_are_kept_apart() {
    let read = |value| {
        let scene = scene::parse_with(&text("tex/leaf.png"), "window.toml", |_| Ok(grey(1, 1, value)));
        scene.unwrap_or_else(|error| panic!("{error}"))
    };
    let mut scene = read(10);
    for value in [20, 20, 30, 10] {
        let mut light = read(value).lights.remove(0);
        light.name = format!("{} {}", scene.lights.len(), light.name);
        scene::keep_apart(&mut light, &scene.lights);
        scene.lights.push(light);
    }
    let files: Vec<_> = (0..5).map(|light| pattern(&scene, light).file.as_str()).collect();
    let expected = ["tex/leaf.png", "tex/leaf-2.png", "tex/leaf-2.png", "tex/leaf-3.png", "tex/leaf.png"];
    assert_eq!(files, expected, "one name a picture");
    let target = tempfile::tempdir().expect("a temporary folder");
    scene::save(&scene, target.path().join("window.toml")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(load(target.path()), scene, "saved and loaded");

    let Shape::Textured(second) = &mut scene.lights[1].shape else { panic!("a textured light") };
    second.pattern.file = "tex/leaf.png".to_owned();
    let error = scene::save(&scene, target.path().join("window.toml")).expect_err("one name for two").to_string();
    insta::assert_snapshot!(error.replace(&format!("{}/", target.path().display()), ""), @"window.toml: not saved, as it could not be opened again: light[1].shape.textured.pattern: `tex/leaf.png` is another picture here than in light[0]; give it its own name");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_make_the_decoders_panic(format in 0..4_usize, damage in proptest::collection::vec((0..2000_usize, any::<u8>()), 1..6)) {
        let format = [ImageFormat::Png, ImageFormat::Jpeg, ImageFormat::OpenExr, ImageFormat::Hdr][format];
        let picture = DynamicImage::ImageRgb32F(ImageBuffer::from_fn(9, 7, |x, y| Rgb([x as f32 / 9.0, y as f32 / 7.0, 0.5])));
        let picture = match format {
            ImageFormat::OpenExr | ImageFormat::Hdr => picture,
            _ => DynamicImage::ImageRgb8(picture.to_rgb8()),
        };
        let mut bytes = encoded(picture, format);
        for (at, byte) in damage {
            let at = at % bytes.len();
            bytes[at] = byte;
        }
        if let Err(error) = scene::parse_with(&text("leaf.png"), "any.toml", |_| Ok(bytes.clone())) {
            prop_assert_eq!(error.to_string().lines().count(), 1, "{}", error);
        }
    }
}
