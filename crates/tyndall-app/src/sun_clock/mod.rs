//! Date, time and place as people think of them: the course of a day, a calendar, places with their clocks.
//!
//! Everything here changes or reads [`tyndall_scene::SunParams`] alone; where the sun stands comes from
//! [`tyndall_scene::Scene::sun_direction`].

pub(crate) mod calendar;
pub(crate) mod day;
pub(crate) mod places;
pub(crate) mod playback;
