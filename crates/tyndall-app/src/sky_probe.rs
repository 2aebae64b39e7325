//! Spectra and luminances of the scene's sky for the plots: computed in f64 from the twin of the tables, by a thread that
//! answers the newest question only.

use std::{
    sync::mpsc::{Receiver, Sender, channel},
    thread,
    time::Instant,
};

use tyndall_core::spectrum::{Spectrum, xyz_from_spectrum};
use tyndall_scattering::{
    Atmosphere,
    geometry::Ray,
    march::Marcher,
    orders::{OrdersQuality, SourceTable, diffuse_radiance},
    single_scattering::single_scattering,
};
use tyndall_scene::{Orders, Scene, SunDirection};

/// Panels of the march: 32 nodes, 0.3 % of the exact integral.
const PANELS: usize = 8;

/// Directions along the sun's meridian on either side of the zenith, evenly spaced in the square root of the elevation:
/// dense at the horizons.
const MERIDIAN_STEPS: usize = 72;

/// Lowest elevation (deg) of the meridian.
const LOWEST_DEG: f64 = 0.05;

/// A direction as seen by the observer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sight {
    /// Above the horizontal (rad).
    pub(crate) elevation_rad: f64,
    /// Clockwise from north (rad).
    pub(crate) azimuth_rad: f64,
}

/// What is to be computed.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Question {
    model: Atmosphere,
    orders: Orders,
    brightness: f64,
    sun: SunDirection,
    altitude_m: f64,
    /// Where the pointer was in the view last.
    cursor: Option<Sight>,
}

impl Question {
    /// From a scene; `None` when it has no sun or its observer is outside of the atmosphere.
    pub(crate) fn new(scene: &Scene, cursor: Option<Sight>) -> Option<Self> {
        let is_inside = scene.camera.altitude_m < scene.atmosphere.top_altitude_km * 1e3;
        Some(Self {
            model: scene.model(),
            orders: scene.sky.orders,
            brightness: scene.sun.brightness,
            sun: scene.sun_direction().ok().filter(|_| is_inside)?,
            altitude_m: scene.camera.altitude_m,
            cursor,
        })
    }

    /// Angle (deg) of the sun along its meridian, as [`MeridianPoint::angle_deg`].
    pub(crate) fn sun_angle_deg(&self) -> f64 {
        self.sun.elevation_rad.to_degrees()
    }
}

/// Light from one direction.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Sample {
    pub(crate) sight: Sight,
    /// Radiance (W/m^2/sr/nm) at the eight wavelengths.
    pub(crate) radiance: Spectrum,
    /// CIE XYZ (cd/m^2 for Y).
    pub(crate) xyz: [f64; 3],
}

/// Luminance of one direction on the meridian of the sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MeridianPoint {
    /// Angle (deg) from the horizon below the sun: 90 is the zenith, 180 the horizon opposite the sun.
    pub(crate) angle_deg: f64,
    /// By all light that the scene counts (cd/m^2).
    pub(crate) luminance_cd_m2: f64,
    /// By light scattered once (cd/m^2).
    pub(crate) once_cd_m2: f64,
}

/// What was asked, and the answer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Answer {
    pub(crate) question: Question,
    pub(crate) cursor: Option<Sample>,
    pub(crate) meridian: Vec<MeridianPoint>,
    /// Time it took (ms), without the table of all orders.
    pub(crate) ms: f64,
}

/// The thread, what it was asked last and what it has answered.
#[derive(Debug, Default)]
pub(crate) struct SkyProbe {
    thread: Option<(Sender<Question>, Receiver<Answer>)>,
    asked: Option<Question>,
    answer: Option<Answer>,
}

impl SkyProbe {
    /// Asks, unless this was the last question already. `wake` is called from the thread when the answer has come.
    pub(crate) fn ask(&mut self, question: Question, wake: impl Fn() + Send + 'static) {
        if self.asked.as_ref() == Some(&question) {
            return;
        }
        let (questions, _) = self.thread.get_or_insert_with(|| start(wake));
        if questions.send(question.clone()).is_ok() {
            self.asked = Some(question);
        }
    }

    /// The newest answer.
    pub(crate) fn answer(&mut self) -> Option<&Answer> {
        if let Some((_, answers)) = &self.thread {
            self.answer = answers.try_iter().last().or(self.answer.take());
        }
        self.answer.as_ref()
    }

    /// Whether an answer is on its way.
    pub(crate) fn is_busy(&self) -> bool {
        self.thread.is_some() && self.asked.as_ref() != self.answer.as_ref().map(|answer| &answer.question)
    }
}

fn start(wake: impl Fn() + Send + 'static) -> (Sender<Question>, Receiver<Answer>) {
    let (questions, received) = channel::<Question>();
    let (sender, answers) = channel();
    let work = move || {
        let mut sky: Option<Sky> = None;
        while let Ok(first) = received.recv() {
            // Older questions have lost their interest.
            let question = received.try_iter().last().unwrap_or(first);
            let kept = sky.take().filter(|sky| sky.is_of(&question));
            let Some(here) = kept.or_else(|| Sky::new(&question)) else { continue };
            let answer = here.answer(question);
            sky = Some(here);
            if sender.send(answer).is_err() {
                return;
            }
            wake();
        }
    };
    // Without a thread the channel is closed and the plots stay empty.
    if let Err(error) = thread::Builder::new().name("sky plots".to_owned()).spawn(work) {
        tracing::warn!(%error, "the sky cannot be plotted");
    }
    (questions, answers)
}

/// An atmosphere, ready to be looked at.
struct Sky {
    orders: Orders,
    marcher: Marcher,
    source: Option<SourceTable>,
}

impl Sky {
    fn new(question: &Question) -> Option<Self> {
        let marcher = Marcher::new(question.model.clone(), PANELS).ok()?;
        let quality = match question.orders {
            Orders::Single => None,
            Orders::Nishita1996 => Some(OrdersQuality::nishita1996()),
            Orders::All => Some(OrdersQuality::preview()),
        };
        let source = quality.map(|quality| source(&marcher, &quality));
        Some(Self { orders: question.orders, marcher, source })
    }

    fn is_of(&self, question: &Question) -> bool {
        self.orders == question.orders && self.marcher.atmosphere == question.model
    }

    fn answer(&self, question: Question) -> Answer {
        let started = Instant::now();
        let cursor = question.cursor.map(|sight| self.sample(&question, sight));
        let meridian = meridian_angles().map(|angle_deg| self.meridian_point(&question, angle_deg)).collect();
        Answer { cursor, meridian, ms: started.elapsed().as_secs_f64() * 1e3, question }
    }

    /// Everything that comes from a direction but the sun's disc: air, aerosol, and the ground behind them.
    fn sample(&self, question: &Question, sight: Sight) -> Sample {
        let ray = ray(question, sight);
        let first = single_scattering(&self.marcher.atmosphere, &ray);
        let more = self.source.as_ref().map_or([0.0; 8], |source| diffuse_radiance(&self.marcher, source, &ray));
        let radiance = std::array::from_fn(|k| question.brightness * (first[k] + more[k]));
        Sample { sight, radiance, xyz: xyz_from_spectrum(&radiance) }
    }

    fn meridian_point(&self, question: &Question, angle_deg: f64) -> MeridianPoint {
        let is_beyond = angle_deg > 90.0;
        let (elevation_deg, turn) =
            if is_beyond { (180.0 - angle_deg, std::f64::consts::PI) } else { (angle_deg, 0.0) };
        let azimuth_rad = question.sun.azimuth_rad + turn;
        let ray = ray(question, Sight { elevation_rad: elevation_deg.to_radians(), azimuth_rad });
        let first = self.scattered_once(&ray);
        let more = self.source.as_ref().map_or([0.0; 8], |source| diffuse_radiance(&self.marcher, source, &ray));
        let luminance = |spectrum: &Spectrum| question.brightness * xyz_from_spectrum(spectrum)[1];
        let all = std::array::from_fn(|k| first[k] + more[k]);
        MeridianPoint { angle_deg, luminance_cd_m2: luminance(&all), once_cd_m2: luminance(&first) }
    }

    /// Radiance by light scattered once, by the fast march.
    fn scattered_once(&self, ray: &Ray) -> Spectrum {
        let parts = self.marcher.scattered_parts(ray);
        let phases = self.marcher.atmosphere.phases(ray.nu);
        std::array::from_fn(|k| parts.iter().zip(phases).map(|(part, phase)| phase * part[k]).sum())
    }
}

/// The table of orders, on one thread: frames are drawn meanwhile.
fn source(marcher: &Marcher, quality: &OrdersQuality) -> SourceTable {
    let make = || SourceTable::new(marcher, quality);
    match rayon::ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(make),
        Err(_no_thread) => make(),
    }
}

fn ray(question: &Question, sight: Sight) -> Ray {
    let [view, sun] = [sight.elevation_rad, question.sun.elevation_rad].map(|e| std::f64::consts::FRAC_PI_2 - e);
    Ray::from_angles(question.altitude_m.max(0.0), view, sun, sight.azimuth_rad - question.sun.azimuth_rad)
}

fn meridian_angles() -> impl Iterator<Item = f64> {
    let side = |step: usize| {
        let share = step as f64 / MERIDIAN_STEPS as f64;
        LOWEST_DEG + (90.0 - LOWEST_DEG) * share * share
    };
    (0..=MERIDIAN_STEPS).map(side).chain((0..MERIDIAN_STEPS).rev().map(move |step| 180.0 - side(step)))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;

    fn question(change: impl FnOnce(&mut Scene)) -> Question {
        let mut scene = Scene::default();
        scene.sky.orders = Orders::Single;
        change(&mut scene);
        Question::new(&scene, None).expect("a sun above an observer in the air")
    }

    #[test]
    fn the_meridian_is_brightest_at_the_sun_and_ends_at_both_horizons() {
        let question = question(|scene| scene.sun.elevation_deg = 40.0);
        let answer = Sky::new(&question).expect("a sky").answer(question);
        let brightest = answer.meridian.iter().max_by(|a, b| a.luminance_cd_m2.total_cmp(&b.luminance_cd_m2));
        let angle_deg = brightest.expect("points").angle_deg;
        assert!((angle_deg - 40.0).abs() < 2.0, "brightest at {angle_deg} deg");
        let [first, .., last] = answer.meridian.as_slice() else { panic!("no points") };
        assert!(first.angle_deg < 0.1 && last.angle_deg > 179.9, "{first:?} {last:?}");
        assert!(answer.meridian.windows(2).all(|pair| pair[0].angle_deg < pair[1].angle_deg), "in order");
    }

    #[test]
    fn a_direction_of_the_meridian_is_the_same_under_the_cursor() {
        let mut question = question(|scene| scene.sky.orders = Orders::All);
        let azimuth_rad = question.sun.azimuth_rad;
        question.cursor = Some(Sight { elevation_rad: 90_f64.to_radians(), azimuth_rad });
        let answer = Sky::new(&question).expect("a sky").answer(question);
        let zenith = answer.meridian[MERIDIAN_STEPS];
        let cursor = answer.cursor.expect("a sample");
        // The march stays within 0.3 % of the exact integral.
        let ratio = zenith.luminance_cd_m2 / cursor.xyz[1];
        assert!((zenith.angle_deg - 90.0).abs() < 1e-9 && (ratio - 1.0).abs() < 4e-3, "{ratio}");
        assert!(zenith.luminance_cd_m2 > 1.1 * zenith.once_cd_m2, "higher orders add light: {zenith:?}");
        assert!(cursor.radiance[0] > cursor.radiance[7], "the zenith is blue");
    }

    #[test]
    fn a_brighter_sun_makes_a_brighter_sky_in_proportion() {
        let [one, two] = [1.0, 2.0].map(|brightness| {
            let question = question(|scene| scene.sun.brightness = brightness);
            Sky::new(&question).expect("a sky").answer(question).meridian[10].luminance_cd_m2
        });
        assert!((two / one - 2.0).abs() < 1e-9, "{one} {two}");
    }

    #[test]
    fn an_observer_outside_of_the_air_asks_nothing() {
        let mut scene = Scene::default();
        scene.camera.altitude_m = scene.atmosphere.top_altitude_km * 1e3 + 1.0;
        assert!(Question::new(&scene, None).is_none(), "there is no sky around it");
    }

    #[test]
    fn the_thread_answers_the_last_question_and_rests() {
        let (sender, woken) = channel();
        let mut probe = SkyProbe::default();
        let last = question(|scene| scene.sun.elevation_deg = 33.0);
        for elevation_deg in [10.0, 20.0, 33.0] {
            let sender = sender.clone();
            let asked = question(|scene| scene.sun.elevation_deg = elevation_deg);
            probe.ask(asked, move || sender.send(()).unwrap_or_default());
        }
        while probe.answer().is_none_or(|answer| answer.question != last) {
            woken.recv_timeout(Duration::from_mins(1)).expect("an answer in time");
        }
        assert!(!probe.is_busy(), "nothing is left to do");
    }
}
