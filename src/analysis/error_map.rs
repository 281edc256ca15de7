//! Where in a picture one method differs from another.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::light::luminance_of;
use crate::render::{
    Geometry, Lighting, MethodChoice, Outgoing, Progress, Reflection, Shadows, Thing, pixel_offsets, prepare,
};
use crate::scene::Scene;

/// Which pictures are compared, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Comparison {
    /// The method in question.
    pub of: MethodChoice,
    /// What it is measured against.
    pub against: MethodChoice,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Rays a pixel, at least 1. Both methods shade the points of the same rays.
    pub samples: u32,
    /// Whether surfaces cast shadows.
    pub shadows: Shadows,
}

/// The difference of two pictures of radiance.
#[derive(Clone, Debug, PartialEq)]
pub struct ErrorMap {
    size: [u32; 2],
    difference: Vec<Option<DVec3>>,
    outline: Vec<bool>,
    summary: Summary,
}

/// An [`ErrorMap`] in numbers: luminances in cd/m², over the pixels that show a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// The difference of greatest magnitude, with its sign.
    pub worst: f64,
    /// Column and row of the pixel that has it, from the upper left.
    pub at: [u32; 2],
    /// Root of the mean squared difference.
    pub rms: f64,
    /// The greatest luminance of a surface by the method that is measured against.
    pub peak: f64,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug)]
struct Pixel {
    /// None where no ray meets a surface.
    mean: Option<Mean>,
    /// What its first ray meets.
    thing: Option<Thing>,
}

/// The mean over a pixel's rays.
#[derive(Clone, Copy, Debug, Default)]
struct Mean {
    difference: DVec3,
    against: DVec3,
}

/// Compare two methods over a scene's picture; none when cancelled.
///
/// Lights that are seen, and the dark behind all surfaces, are the same by every method: they are left out.
pub fn error_map(scene: &Scene, comparison: &Comparison, progress: &Progress) -> Option<ErrorMap> {
    let (geometry, of) = prepare(scene, comparison.of, comparison.shadows);
    let (_, against) = prepare(scene, comparison.against, comparison.shadows);
    let view = View {
        geometry,
        lightings: [of, against],
        reflections: scene.materials.iter().map(Reflection::new).collect(),
        scene,
        size: DVec2::from(comparison.size.map(f64::from)),
        offsets: pixel_offsets(comparison.samples),
    };
    let [width, height] = comparison.size;
    let row = |y: u32| -> Option<Vec<Pixel>> {
        let row = (0..width)
            .map(|x| {
                let corner = DVec2::new(f64::from(x), f64::from(y));
                (!progress.is_cancelled()).then(|| view.pixel(corner))
            })
            .collect();
        progress.advance(u64::from(width));
        row
    };
    let rows: Option<Vec<_>> = (0..height).into_par_iter().map(row).collect();
    let pixels = rows?.concat();
    Some(ErrorMap {
        size: comparison.size,
        difference: pixels.iter().map(|pixel| Some(pixel.mean?.difference)).collect(),
        outline: outline(width as usize, &pixels),
        summary: summarise(comparison.size, &pixels),
    })
}

impl ErrorMap {
    /// Width and height in pixels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// L_out by the one method less that by the other, cd/m² of linear Rec. 709, row by row from the upper left
    /// corner; none where no surface is seen.
    pub fn difference(&self) -> &[Option<DVec3>] {
        &self.difference
    }

    /// The differences as luminance, cd/m².
    pub fn luminance(&self) -> impl Iterator<Item = Option<f64>> {
        self.difference.iter().map(|difference| difference.map(luminance_of))
    }

    /// Whether a pixel shows another thing than its neighbour to the right or below.
    pub fn outline(&self) -> &[bool] {
        &self.outline
    }

    /// How far the pictures differ.
    pub fn summary(&self) -> Summary {
        self.summary
    }
}

fn outline(width: usize, pixels: &[Pixel]) -> Vec<bool> {
    let differs = |i: usize, j: usize| pixels.get(j).is_some_and(|other| other.thing != pixels[i].thing);
    let outlined = |i: usize| differs(i, i + width) || !(i + 1).is_multiple_of(width) && differs(i, i + 1);
    (0..pixels.len()).map(outlined).collect()
}

fn summarise(size: [u32; 2], pixels: &[Pixel]) -> Summary {
    let mut summary = Summary::default();
    let (mut squares, mut count) = (0.0_f64, 0.0);
    let places = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y]));
    for (at, mean) in places.zip(pixels).filter_map(|(at, pixel)| Some((at, pixel.mean?))) {
        let difference = luminance_of(mean.difference);
        if difference.abs() > summary.worst.abs() {
            (summary.worst, summary.at) = (difference, at);
        }
        summary.peak = summary.peak.max(luminance_of(mean.against));
        squares += difference * difference;
        count += 1.0;
    }
    if count > 0.0 {
        summary.rms = (squares / count).sqrt();
    }
    summary
}

/// Everything that a ray needs to know.
struct View<'a> {
    geometry: Geometry,
    /// The method in question, and what it is measured against.
    lightings: [Lighting; 2],
    reflections: Vec<Reflection>,
    scene: &'a Scene,
    size: DVec2,
    offsets: Vec<DVec2>,
}

impl View<'_> {
    /// The mean over a pixel's rays.
    fn pixel(&self, corner: DVec2) -> Pixel {
        let share = (self.offsets.len() as f64).recip();
        let mut pixel = Pixel { mean: None, thing: None };
        for (i, &offset) in self.offsets.iter().enumerate() {
            let (thing, outgoing) = self.ray(corner + offset);
            if i == 0 {
                pixel.thing = thing;
            }
            if let Some([of, against]) = outgoing {
                let mean = pixel.mean.get_or_insert_default();
                mean.difference += share * (of.radiance - against.radiance);
                mean.against += share * against.radiance;
            }
        }
        pixel
    }

    /// What a ray meets, and what leaves it by each method if it is a surface.
    fn ray(&self, at: DVec2) -> (Option<Thing>, Option<[Outgoing; 2]>) {
        let camera = self.scene.camera;
        let direction = camera.ray_direction(at.x, at.y, self.size.x, self.size.y);
        let Some(seen) = self.geometry.nearest(camera.eye, direction) else { return (None, None) };
        let Thing::Surface(surface) = seen.thing else { return (Some(seen.thing), None) };
        let reflection = self.geometry.material(surface).and_then(|material| self.reflections.get(material));
        let at = seen.shading_point(direction);
        let outgoing = reflection
            .map(|reflection| self.lightings.each_ref().map(|lighting| lighting.outgoing_on(surface, reflection, &at)));
        (Some(seen.thing), outgoing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shading::Method;

    fn map(of: &str, against: &str, samples: u32) -> ErrorMap {
        let scene = crate::scene::first_light();
        let [of, against] = [of, against].map(|name| name.parse::<MethodChoice>().unwrap());
        error_map(
            &scene,
            &Comparison { of, against, size: [48, 27], samples, shadows: Shadows::None },
            &Progress::default(),
        )
        .unwrap()
    }

    #[test]
    fn a_method_does_not_differ_from_itself() {
        let summary = map("exact", "exact", 2).summary();
        assert_eq!([summary.worst, summary.rms], [0.0; 2], "{summary:?}");
        assert!(summary.peak > 1.0, "{summary:?}");
    }

    #[test]
    fn the_difference_changes_sign_with_its_direction() {
        let (there, back) = (map("point", "exact", 1), map("exact", "point", 1));
        for (there, back) in there.luminance().zip(back.luminance()) {
            assert_eq!(there, back.map(|back| -back), "a pixel");
        }
        assert_eq!(there.summary().worst, -back.summary().worst, "the worst");
    }

    #[test]
    fn the_summary_is_that_of_the_pixels() {
        let map = map("point", "exact", 4);
        let summary = map.summary();
        let values: Vec<f64> = map.luminance().flatten().collect();
        let rms = (values.iter().map(|x| x * x).sum::<f64>() / values.len() as f64).sqrt();
        let worst = values.iter().copied().fold(0.0, |worst: f64, x| if x.abs() > worst.abs() { x } else { worst });
        assert!((summary.rms / rms - 1.0).abs() < 1e-12 && summary.worst == worst, "{summary:?}, {rms}, {worst}");
        let [x, y] = summary.at.map(|i| i as usize);
        assert_eq!(map.luminance().nth(y * 48 + x), Some(Some(worst)), "the place of the worst");
        assert!(summary.rms > 0.0 && summary.rms < worst.abs(), "{summary:?}");
        let outlined = map.outline().iter().filter(|outlined| **outlined).count();
        assert!((20..400).contains(&outlined), "{outlined} pixels are outlined");
    }

    #[test]
    fn it_is_the_difference_of_two_pictures() {
        use crate::render::{Settings, Shadows, render};
        let scene = crate::scene::first_light();
        let film = |method| {
            let settings =
                Settings { size: [48, 27], choice: MethodChoice::Method(method), samples: 1, shadows: Shadows::None };
            render(&scene, &settings, &Progress::default()).unwrap()
        };
        let (point, exact) = (film(Method::Point), film(Method::Exact));
        let map = map("point", "exact", 1);
        for ((point, exact), difference) in point.radiance().iter().zip(exact.radiance()).zip(map.difference()) {
            let expected = *point - *exact;
            let difference = difference.unwrap_or_default();
            assert!((difference - expected).length() <= 1e-12 * exact.length(), "{difference} is not {expected}");
        }
    }

    #[test]
    fn what_shows_no_surface_is_left_out() {
        let mut scene = crate::scene::first_light();
        scene.surfaces.retain(|surface| surface.name == "ball");
        let choice = MethodChoice::Approx;
        let comparison = Comparison { of: choice, against: choice, size: [48, 27], samples: 1, shadows: Shadows::None };
        let map = error_map(&scene, &comparison, &Progress::default()).unwrap();
        let shown = map.difference().iter().flatten().count();
        assert!((10..700).contains(&shown), "{shown} of 1296 pixels show the ball");
    }

    #[test]
    fn a_cancelled_map_is_none() {
        let progress = Progress::default();
        progress.cancel();
        let choice = MethodChoice::Approx;
        let comparison = Comparison { of: choice, against: choice, size: [4, 4], samples: 1, shadows: Shadows::None };
        assert_eq!(error_map(&crate::scene::first_light(), &comparison, &progress), None, "cancelled");
    }
}
