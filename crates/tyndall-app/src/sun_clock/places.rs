//! Places with their clocks. Coordinates are those of the places' centres to a hundredth of a degree; offsets from UTC
//! follow the rules of their time zones, summer time included.

use jiff::tz::TimeZone;
use tyndall_scene::{SunParams, SunPosition};

use super::calendar::date;

/// A place on Earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub(crate) name: &'static str,
    pub(crate) country: &'static str,
    latitude_deg: f64,
    longitude_deg: f64,
    /// Name in the time zone database.
    zone: &'static str,
}

/// Distance (deg) within which the scene's place is a listed one.
const SAME_PLACE_DEG: f64 = 1e-4;

/// Offsets from UTC (h) that count as equal.
const SAME_OFFSET_H: f64 = 1e-6;

const fn place(
    name: &'static str,
    country: &'static str,
    latitude_deg: f64,
    longitude_deg: f64,
    zone: &'static str,
) -> Place {
    Place { name, country, latitude_deg, longitude_deg, zone }
}

/// All places, in the order of the alphabet.
pub(crate) const PLACES: &[Place] = &[
    place("Adelaide", "Australia", -34.93, 138.6, "Australia/Adelaide"),
    place("Amsterdam", "Netherlands", 52.37, 4.9, "Europe/Amsterdam"),
    place("Anchorage", "United States", 61.22, -149.9, "America/Anchorage"),
    place("Antananarivo", "Madagascar", -18.91, 47.54, "Indian/Antananarivo"),
    place("Athens", "Greece", 37.98, 23.73, "Europe/Athens"),
    place("Auckland", "New Zealand", -36.85, 174.76, "Pacific/Auckland"),
    place("Bangkok", "Thailand", 13.76, 100.5, "Asia/Bangkok"),
    place("Beijing", "China", 39.9, 116.41, "Asia/Shanghai"),
    place("Bergen", "Norway", 60.39, 5.32, "Europe/Oslo"),
    place("Berlin", "Germany", 52.52, 13.41, "Europe/Berlin"),
    place("Bogota", "Colombia", 4.71, -74.07, "America/Bogota"),
    place("Buenos Aires", "Argentina", -34.6, -58.38, "America/Argentina/Buenos_Aires"),
    place("Cairo", "Egypt", 30.04, 31.24, "Africa/Cairo"),
    place("Cape Town", "South Africa", -33.92, 18.42, "Africa/Johannesburg"),
    place("Chicago", "United States", 41.88, -87.63, "America/Chicago"),
    place("Death Valley", "United States", 36.46, -116.87, "America/Los_Angeles"),
    place("Delhi", "India", 28.61, 77.21, "Asia/Kolkata"),
    place("Denver", "United States", 39.74, -104.99, "America/Denver"),
    place("Dubai", "United Arab Emirates", 25.2, 55.27, "Asia/Dubai"),
    place("Dublin", "Ireland", 53.35, -6.26, "Europe/Dublin"),
    place("Edinburgh", "United Kingdom", 55.95, -3.19, "Europe/London"),
    place("Greenwich", "United Kingdom", 51.4779, 0.0, "Europe/London"),
    place("Halley Station", "Antarctica", -75.57, -25.51, "Antarctica/Rothera"),
    place("Helsinki", "Finland", 60.17, 24.94, "Europe/Helsinki"),
    place("Hiroshima", "Japan", 34.39, 132.46, "Asia/Tokyo"),
    place("Hong Kong", "China", 22.32, 114.17, "Asia/Hong_Kong"),
    place("Honolulu", "United States", 21.31, -157.86, "Pacific/Honolulu"),
    place("Istanbul", "Turkey", 41.01, 28.98, "Europe/Istanbul"),
    place("Jakarta", "Indonesia", -6.21, 106.85, "Asia/Jakarta"),
    place("Jerusalem", "Israel", 31.77, 35.21, "Asia/Jerusalem"),
    place("Johannesburg", "South Africa", -26.2, 28.05, "Africa/Johannesburg"),
    place("Karachi", "Pakistan", 24.86, 67.0, "Asia/Karachi"),
    place("Kathmandu", "Nepal", 27.72, 85.32, "Asia/Kathmandu"),
    place("Kinshasa", "DR Congo", -4.44, 15.27, "Africa/Kinshasa"),
    place("Kyiv", "Ukraine", 50.45, 30.52, "Europe/Kyiv"),
    place("La Palma Observatory", "Spain", 28.76, -17.89, "Atlantic/Canary"),
    place("Lagos", "Nigeria", 6.52, 3.38, "Africa/Lagos"),
    place("La Paz", "Bolivia", -16.49, -68.12, "America/La_Paz"),
    place("Lima", "Peru", -12.05, -77.04, "America/Lima"),
    place("Lisbon", "Portugal", 38.72, -9.14, "Europe/Lisbon"),
    place("London", "United Kingdom", 51.51, -0.13, "Europe/London"),
    place("Longyearbyen", "Svalbard", 78.22, 15.65, "Arctic/Longyearbyen"),
    place("Los Angeles", "United States", 34.05, -118.24, "America/Los_Angeles"),
    place("Madrid", "Spain", 40.42, -3.7, "Europe/Madrid"),
    place("Manila", "Philippines", 14.6, 120.98, "Asia/Manila"),
    place("Marrakesh", "Morocco", 31.63, -7.99, "Africa/Casablanca"),
    place("Mauna Kea", "United States", 19.82, -155.47, "Pacific/Honolulu"),
    place("Mecca", "Saudi Arabia", 21.42, 39.83, "Asia/Riyadh"),
    place("Melbourne", "Australia", -37.81, 144.96, "Australia/Melbourne"),
    place("Mexico City", "Mexico", 19.43, -99.13, "America/Mexico_City"),
    place("Miami", "United States", 25.76, -80.19, "America/New_York"),
    place("Monument Valley", "United States", 36.98, -110.11, "America/Denver"),
    place("Moscow", "Russia", 55.76, 37.62, "Europe/Moscow"),
    place("Mumbai", "India", 19.08, 72.88, "Asia/Kolkata"),
    place("Munich", "Germany", 48.14, 11.58, "Europe/Berlin"),
    place("Nairobi", "Kenya", -1.29, 36.82, "Africa/Nairobi"),
    place("New York", "United States", 40.71, -74.01, "America/New_York"),
    place("North Pole", "Arctic Ocean", 90.0, 0.0, "UTC"),
    place("Nuuk", "Greenland", 64.18, -51.74, "America/Nuuk"),
    place("Oslo", "Norway", 59.91, 10.75, "Europe/Oslo"),
    place("Paranal Observatory", "Chile", -24.63, -70.4, "America/Santiago"),
    place("Paris", "France", 48.86, 2.35, "Europe/Paris"),
    place("Perth", "Australia", -31.95, 115.86, "Australia/Perth"),
    place("Quito", "Ecuador", -0.18, -78.47, "America/Guayaquil"),
    place("Reykjavik", "Iceland", 64.15, -21.94, "Atlantic/Reykjavik"),
    place("Rio de Janeiro", "Brazil", -22.91, -43.17, "America/Sao_Paulo"),
    place("Rome", "Italy", 41.9, 12.5, "Europe/Rome"),
    place("San Francisco", "United States", 37.77, -122.42, "America/Los_Angeles"),
    place("San Pedro de Atacama", "Chile", -22.91, -68.2, "America/Santiago"),
    place("Santiago", "Chile", -33.45, -70.67, "America/Santiago"),
    place("Sao Paulo", "Brazil", -23.55, -46.63, "America/Sao_Paulo"),
    place("Seoul", "South Korea", 37.57, 126.98, "Asia/Seoul"),
    place("Shanghai", "China", 31.23, 121.47, "Asia/Shanghai"),
    place("Singapore", "Singapore", 1.35, 103.82, "Asia/Singapore"),
    place("South Pole", "Antarctica", -90.0, 0.0, "Antarctica/McMurdo"),
    place("Stockholm", "Sweden", 59.33, 18.07, "Europe/Stockholm"),
    place("Sydney", "Australia", -33.87, 151.21, "Australia/Sydney"),
    place("Tamanrasset", "Algeria", 22.79, 5.52, "Africa/Algiers"),
    place("Tokyo", "Japan", 35.68, 139.69, "Asia/Tokyo"),
    place("Toronto", "Canada", 43.65, -79.38, "America/Toronto"),
    place("Tromso", "Norway", 69.65, 18.96, "Europe/Oslo"),
    place("Uluru", "Australia", -25.34, 131.04, "Australia/Darwin"),
    place("Ushuaia", "Argentina", -54.8, -68.3, "America/Argentina/Ushuaia"),
    place("Vancouver", "Canada", 49.28, -123.12, "America/Vancouver"),
    place("Vienna", "Austria", 48.21, 16.37, "Europe/Vienna"),
    place("Zermatt", "Switzerland", 46.02, 7.75, "Europe/Zurich"),
];

impl Place {
    /// The listed place where the parameters are.
    pub(crate) fn of(sun: &SunParams) -> Option<&'static Self> {
        let near = |a: f64, b: f64| (a - b).abs() < SAME_PLACE_DEG;
        PLACES
            .iter()
            .find(|place| near(place.latitude_deg, sun.latitude_deg) && near(place.longitude_deg, sun.longitude_deg))
    }

    /// Places whose name or country has every word of the text.
    pub(crate) fn search(text: &str) -> impl Iterator<Item = &'static Self> {
        let words: Vec<String> = text.to_lowercase().split_whitespace().map(str::to_owned).collect();
        PLACES.iter().filter(move |place| {
            let known = format!("{} {}", place.name, place.country).to_lowercase();
            words.iter().all(|word| known.contains(word.as_str()))
        })
    }

    /// Goes to the place; the clock shows the same time, told by the place's own rules.
    pub(crate) fn visit(&self, sun: &mut SunParams) {
        (sun.latitude_deg, sun.longitude_deg) = (self.latitude_deg, self.longitude_deg);
        sun.position = SunPosition::Date;
        if let Some(offset_h) = self.utc_offset_h(sun) {
            sun.utc_offset_h = offset_h;
        }
    }

    /// How far (h) the place's clock is ahead of UTC at the date and time of the parameters; `None` when the date does not
    /// exist.
    pub(crate) fn utc_offset_h(&self, sun: &SunParams) -> Option<f64> {
        let zone = TimeZone::get(self.zone).ok()?;
        #[expect(clippy::cast_possible_truncation, reason = "hours and minutes of a day")]
        let (hour, minute) = (sun.time_h.floor().min(23.0) as i8, (sun.time_h.fract() * 60.0).floor() as i8);
        let local = date(sun)?.at(hour, minute, 0, 0);
        let instant = zone.to_ambiguous_zoned(local).compatible().ok()?;
        Some(f64::from(instant.offset().seconds()) / 3600.0)
    }
}

/// Changes the date or the time; the offset from UTC follows summer time where it did before.
pub(crate) fn keep_clock(sun: &mut SunParams, change: impl FnOnce(&mut SunParams)) {
    let follows = Place::of(sun).filter(|place| {
        place.utc_offset_h(sun).is_some_and(|offset_h| (offset_h - sun.utc_offset_h).abs() < SAME_OFFSET_H)
    });
    change(sun);
    if let Some(offset_h) = follows.and_then(|place| place.utc_offset_h(sun)) {
        sun.utc_offset_h = offset_h;
    }
}

#[cfg(test)]
mod tests {
    use super::super::calendar::{Step, step};
    use super::*;

    fn named(name: &str) -> &'static Place {
        PLACES.iter().find(|place| place.name == name).expect("a listed place")
    }

    #[test]
    fn every_place_is_on_earth_once_and_its_time_zone_exists() {
        for (index, place) in PLACES.iter().enumerate() {
            assert!(place.latitude_deg.abs() <= 90.0 && place.longitude_deg.abs() <= 180.0, "{place:?}");
            assert!(TimeZone::get(place.zone).is_ok(), "{place:?}");
            assert!(PLACES[..index].iter().all(|other| other.name != place.name), "{} is listed twice", place.name);
            let sun = SunParams {
                latitude_deg: place.latitude_deg,
                longitude_deg: place.longitude_deg,
                ..SunParams::default()
            };
            assert_eq!(Place::of(&sun), Some(place), "{} is found where it is", place.name);
        }
    }

    #[test]
    fn clocks_are_near_the_sun() {
        // Wide zones and summer time set clocks up to two and a half hours ahead of the sun.
        for place in PLACES.iter().filter(|place| place.latitude_deg.abs() < 70.0) {
            let offset_h = place.utc_offset_h(&SunParams::default()).expect("a date that exists");
            let apart_h = (offset_h - place.longitude_deg / 15.0 + 12.0).rem_euclid(24.0) - 12.0;
            assert!(apart_h.abs() < 3.0, "{}: the clock is {apart_h} h ahead of the sun", place.name);
        }
    }

    #[test]
    fn summer_time_comes_and_goes_with_the_date() {
        let mut sun = SunParams { month: 3, day: 28, time_h: 12.0, ..SunParams::default() };
        named("Berlin").visit(&mut sun);
        assert!((sun.utc_offset_h - 1.0).abs() < 1e-9, "winter: {sun:?}");
        // In the European Union it began on 29 March 2026.
        keep_clock(&mut sun, |sun| step(sun, Step::Days(1)));
        assert!((sun.utc_offset_h - 2.0).abs() < 1e-9, "summer: {sun:?}");
        sun.utc_offset_h = 0.5;
        keep_clock(&mut sun, |sun| step(sun, Step::Months(8)));
        assert!((sun.utc_offset_h - 0.5).abs() < 1e-9, "the user's own offset stays: {sun:?}");
    }

    #[test]
    fn places_are_found_by_parts_of_name_and_country() {
        let names = |text: &str| Place::search(text).map(|place| place.name).collect::<Vec<_>>();
        assert_eq!(names("trom"), ["Tromso"], "by name");
        assert_eq!(names("norway berg"), ["Bergen"], "by country and name");
        assert_eq!(names("zzz"), [""; 0], "nothing");
        assert_eq!(names("").len(), PLACES.len(), "everything");
    }
}
