//! The tables of the scene's sky against Monte-Carlo.

use tyndall_scattering::{
    Atmosphere,
    orders::OrdersQuality,
    validate::{Report, ValidateOptions, validate},
};
use tyndall_scene::{Orders, OrdersDetail, Scene};

use crate::meter::Meter;

/// How long the user is ready to wait.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Thoroughness {
    #[default]
    Quick,
    Normal,
    Thorough,
}

impl Thoroughness {
    /// All, the quickest first.
    pub(crate) const ALL: [Self; 3] = [Self::Quick, Self::Normal, Self::Thorough];

    /// Name of the choice, and what it takes.
    pub(crate) fn label(self) -> (&'static str, &'static str) {
        match self {
            Self::Quick => ("Quick", "40 directions, 2048 walks each: about two seconds, noise of one per cent."),
            Self::Normal => ("Normal", "60 directions, 8192 walks each: about ten seconds."),
            Self::Thorough => ("Thorough", "200 directions, 65536 walks each: minutes, noise of a few per mille."),
        }
    }

    /// Directions and walks in each.
    fn size(self) -> (usize, u32) {
        match self {
            Self::Quick => (40, 2048),
            Self::Normal => (60, 8192),
            Self::Thorough => (200, 65_536),
        }
    }
}

/// What is judged.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Subject {
    model: Atmosphere,
    quality: OrdersQuality,
    altitude_m: f64,
    mu_sun: f64,
}

impl Subject {
    /// The sky of a scene; `None` when it has no sun.
    pub(crate) fn of(scene: &Scene) -> Option<Self> {
        let quality = match (scene.sky.orders, scene.sky.orders_detail) {
            (Orders::Nishita1996, _) => OrdersQuality::nishita1996(),
            (Orders::Single | Orders::All, OrdersDetail::Preview) => OrdersQuality::preview(),
            (Orders::Single | Orders::All, OrdersDetail::Best) => OrdersQuality::best(),
        };
        let mu_sun = scene.sun_direction().ok()?.elevation_rad.sin();
        Some(Self { model: scene.model(), quality, altitude_m: scene.camera.altitude_m, mu_sun })
    }
}

/// Comparisons of skies.
pub(crate) type ErrorMeter = Meter<Subject, Report>;

/// Starts a comparison of a sky; `wake` is called whenever there is news.
pub(crate) fn start(
    meter: &mut ErrorMeter,
    subject: Subject,
    thoroughness: Thoroughness,
    wake: impl Fn() + Send + Sync + 'static,
) {
    let (directions, paths) = thoroughness.size();
    let options = ValidateOptions { directions, paths, quality: subject.quality, ..ValidateOptions::default() };
    let compare = move |judged: &Subject, progress: &(dyn Fn(f64) -> bool + Sync)| {
        let observer = (judged.altitude_m, judged.mu_sun);
        validate(&judged.model, observer, &options, progress).map_err(|error| error.to_string())
    };
    meter.start(subject, compare, wake);
}

#[cfg(test)]
mod tests {
    use std::{sync::mpsc::channel, time::Duration};

    use super::*;

    fn subject(change: impl FnOnce(&mut Scene)) -> Subject {
        let mut scene = Scene::default();
        scene.sky.orders_detail = OrdersDetail::Preview;
        change(&mut scene);
        Subject::of(&scene).expect("a scene with a sun")
    }

    #[test]
    fn a_comparison_runs_to_its_end_and_tells_its_progress() {
        let (sender, woken) = channel();
        let mut meter = ErrorMeter::default();
        start(&mut meter, subject(|_| {}), Thoroughness::Quick, move || sender.send(()).unwrap_or_default());
        let mut shares = Vec::new();
        while let Some(share) = meter.progress() {
            shares.push(share);
            woken.recv_timeout(Duration::from_mins(2)).expect("news in time");
        }
        assert!(shares.is_sorted(), "progress never falls: {shares:?}");
        let outcome = meter.outcome().expect("a report");
        assert_eq!(outcome.report.rows.len(), Thoroughness::Quick.size().0, "all directions");
        // The preview's tables are good to a few per cent, and so is the noise of 2048 walks.
        let whole = outcome.report.whole();
        assert!(whole.luminance.median_pct < 5.0, "{whole:?}");
    }

    #[test]
    fn a_cancelled_comparison_leaves_no_report() {
        let mut meter = ErrorMeter::default();
        start(&mut meter, subject(|_| {}), Thoroughness::Thorough, || {});
        meter.cancel();
        assert!(meter.progress().is_none() && meter.outcome().is_none(), "nothing is left");
    }

    #[test]
    fn another_air_is_another_subject_and_another_title_is_not() {
        let subjects = [subject(|_| {}), subject(|scene| scene.title = "Mine".to_owned())];
        assert_eq!(subjects[0], subjects[1], "the title changes no sky");
        assert_ne!(subjects[0], subject(|scene| scene.atmosphere.ozone_du = 100.0), "less ozone");
    }
}
