//! Steps of date and time that carry over into days, months and years, and the present.

use jiff::{Span, Timestamp, civil};
use tyndall_core::ParamSet;
use tyndall_scene::{SunParams, SunPosition};

use super::day::HOURS;

/// A step of the calendar.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    Days(i32),
    Months(i32),
}

/// The date of the parameters; `None` when it does not exist.
pub(crate) fn date(sun: &SunParams) -> Option<civil::Date> {
    let (year, month, day) = (sun.year.try_into().ok()?, sun.month.try_into().ok()?, sun.day.try_into().ok()?);
    civil::Date::new(year, month, day).ok()
}

/// Writes a date into the parameters and lets the sun follow it. Years outside of what parameters take change nothing.
pub(crate) fn set_date(sun: &mut SunParams, date: civil::Date) {
    let Ok(year) = u32::try_from(date.year()) else { return };
    let known = ParamSet::position(sun, "year").ok().map(|index| &sun.info()[index]);
    if known.is_none_or(|info| info.check(f64::from(year)).is_err()) {
        return;
    }
    (sun.year, sun.month, sun.day) = (year, date.month().unsigned_abs().into(), date.day().unsigned_abs().into());
    sun.position = SunPosition::Date;
}

/// Goes some days or months further; the last day of a month stays within its month.
pub(crate) fn step(sun: &mut SunParams, step: Step) {
    let Some(from) = date(sun).or_else(|| last_day_of_month(sun)) else { return };
    let span = match step {
        Step::Days(days) => Span::new().days(days),
        Step::Months(months) => Span::new().months(months),
    };
    if let Ok(to) = from.checked_add(span) {
        set_date(sun, to);
    }
}

/// Moves the clock, over midnight into another date if need be.
pub(crate) fn advance(sun: &mut SunParams, hours: f64) {
    let time_h = sun.time_h + hours;
    let days = (time_h / HOURS).floor();
    if days != 0.0 {
        #[expect(clippy::cast_possible_truncation, reason = "a few days at the most")]
        step(sun, Step::Days(days as i32));
    }
    sun.time_h = time_h - days * HOURS;
    sun.position = SunPosition::Date;
}

/// Sets date and time to the present on the clock of the parameters.
pub(crate) fn set_now(sun: &mut SunParams, now: Timestamp) {
    #[expect(clippy::cast_possible_truncation, reason = "seconds of a day at the most")]
    let offset_s = (sun.utc_offset_h * 3600.0).round() as i64;
    let Ok(local) = now.checked_add(Span::new().seconds(offset_s)) else { return };
    let local = jiff::tz::Offset::UTC.to_datetime(local);
    set_date(sun, local.date());
    let seconds = local.time().duration_since(civil::Time::midnight()).as_secs_f64();
    sun.time_h = (seconds / 60.0).floor() / 60.0;
}

/// The last day of the month of a date that does not exist, as 30 February.
fn last_day_of_month(sun: &SunParams) -> Option<civil::Date> {
    date(&SunParams { day: 1, ..sun.clone() }).map(civil::Date::last_of_month)
}

/// A date as people write it, with its day of the week.
pub(crate) fn text(sun: &SunParams) -> String {
    date(sun).map_or_else(
        || format!("{}-{:02}-{:02} does not exist", sun.year, sun.month, sun.day),
        |date| date.strftime("%a %-d %b %Y").to_string(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sun((year, month, day): (u32, u32, u32), time_h: f64) -> SunParams {
        SunParams { year, month, day, time_h, ..SunParams::default() }
    }

    fn day_of(sun: &SunParams) -> (u32, u32, u32) {
        (sun.year, sun.month, sun.day)
    }

    #[test]
    fn steps_carry_over_months_and_leap_years() {
        for (from, by, to) in [
            ((2026, 12, 31), Step::Days(1), (2027, 1, 1)),
            ((2024, 3, 1), Step::Days(-1), (2024, 2, 29)),
            ((2026, 1, 31), Step::Months(1), (2026, 2, 28)),
            ((2026, 3, 31), Step::Months(-12), (2025, 3, 31)),
            ((2026, 2, 31), Step::Days(1), (2026, 3, 1)),
        ] {
            let mut sun = sun(from, 12.0);
            step(&mut sun, by);
            assert_eq!(day_of(&sun), to, "{from:?} and {by:?}");
            assert_eq!(sun.position, SunPosition::Date, "the sun follows the date");
        }
    }

    #[test]
    fn the_calendar_ends_where_the_parameters_end() {
        let mut last = sun((2999, 12, 31), 12.0);
        step(&mut last, Step::Days(1));
        assert_eq!(day_of(&last), (2999, 12, 31), "there is no year 3000");
    }

    #[test]
    fn the_clock_runs_over_midnight_in_both_directions() {
        let mut there = sun((2026, 6, 30), 23.5);
        advance(&mut there, 1.25);
        assert!(day_of(&there) == (2026, 7, 1) && (there.time_h - 0.75).abs() < 1e-9, "{there:?}");
        advance(&mut there, -1.25);
        assert!(day_of(&there) == (2026, 6, 30) && (there.time_h - 23.5).abs() < 1e-9, "{there:?}");
        advance(&mut there, 49.0);
        // 23:30 on 30 June and 49 hours.
        assert!(day_of(&there) == (2026, 7, 3) && (there.time_h - 0.5).abs() < 1e-9, "{there:?}");
    }

    #[test]
    fn now_is_told_by_the_clock_of_the_place() {
        let now: Timestamp = "2026-02-28T22:40:30Z".parse().unwrap();
        let mut there = SunParams { utc_offset_h: 5.5, ..SunParams::default() };
        set_now(&mut there, now);
        assert!(day_of(&there) == (2026, 3, 1) && (there.time_h - (4.0 + 10.0 / 60.0)).abs() < 1e-9, "{there:?}");
    }

    #[test]
    fn dates_are_written_for_people() {
        assert_eq!(text(&sun((2026, 6, 21), 0.0)), "Sun 21 Jun 2026", "a date");
        assert_eq!(text(&sun((2026, 2, 30), 0.0)), "2026-02-30 does not exist", "no date");
    }
}
