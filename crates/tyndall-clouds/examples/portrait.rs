//! Follows light through the clouds of a pattern and writes a picture: `portrait cumulus-field clouds.png [paths]`.
//!
//! The slow reference of the crate, not a renderer: a minute for a small picture.

use std::error::Error;
use std::fs::File;

use tyndall_clouds::reference::{Light, Medium, PathPicture, PathSettings, Ray, TabulatedPhase, path_picture};
use tyndall_clouds::{CloudSimulation, VapourPattern};

const SIZE_PX: [usize; 2] = [320, 180];
/// Radiance of the sky for a sun of irradiance 1.
const SKY: f64 = 0.06;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (Some(name), Some(file)) = (arguments.next(), arguments.next()) else {
        return Err("portrait PATTERN FILE.png [PATHS]".into());
    };
    let samples = arguments.next().map_or(Ok(16), |text| text.parse())?;
    let pattern = VapourPattern::ALL.iter().find(|pattern| pattern.name() == name);
    let params = pattern.ok_or_else(|| format!("{name} is none of {:?}", VapourPattern::NAMES))?.preset();
    let mut simulation = CloudSimulation::new(&params)?;
    let medium = Medium::new(simulation.extinction_per_m(1.0)?, params.grid.cell_m)?;
    let phase = TabulatedPhase::new(|cosine| {
        let lobe = |g: f64| (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine).powf(1.5);
        0.8 * lobe(0.8) + 0.2 * lobe(-0.3)
    })?;
    let light = Light { to_sun: [-0.6, -0.5, 0.6], sun_irradiance: 1.0, sky_radiance: SKY };
    let settings = PathSettings { albedo: 0.9999, max_orders: 200, samples, seed: 1 };
    let [east, _, up] = medium.extent();
    let ray = |[x, y]: [f64; 2]| {
        let (across, above) = (x / SIZE_PX[0] as f64 - 0.5, 0.5 - y / SIZE_PX[1] as f64);
        Ray {
            origin: [0.5 * east, -0.35 * east, 0.5 * up + 0.13 * east],
            direction: [1.2 * across, 1.0, 0.68 * above - 0.22],
        }
    };
    let pixels = path_picture(&medium, &phase, &light, &settings, &PathPicture { size_px: SIZE_PX, ray: &ray });
    let blue = [0.35, 0.6, 1.4];
    let rgb = pixels.iter().flat_map(|pixel| {
        blue.map(|tint| developed(pixel.radiance * (1.0 + 0.1 * (tint - 0.8)) + (1.0 - pixel.opacity) * SKY * tint))
    });
    let [width, height] = [320, 180];
    let mut encoder = png::Encoder::new(File::create(file)?, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header()?.write_image_data(&rgb.collect::<Vec<u8>>())?;
    Ok(())
}

/// Exposure and a soft shoulder.
#[expect(clippy::cast_possible_truncation, reason = "between 0 and 255")]
fn developed(radiance: f64) -> u8 {
    let exposed = 1.0 - (-6.0 * radiance).exp();
    (255.0 * exposed.powf(1.0 / 2.2)) as u8
}
