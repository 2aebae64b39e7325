//! Everything that can be wrong with a scene.

use tyndall_core::ParamError;

/// Why a scene was refused. Every message names the parameter by its path, its value, its unit and what is allowed.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// No group of that name.
    #[error("unknown group `{name}`{}", hint(nearest.as_deref()))]
    UnknownGroup {
        /// The name as the user wrote it.
        name: String,
        /// The known name that is most like it.
        nearest: Option<String>,
    },
    /// No parameter of that name in the group.
    #[error("unknown parameter `{path}`{}", hint(nearest.as_deref()))]
    UnknownParameter {
        /// The path as the user wrote it.
        path: String,
        /// The known path that is most like it.
        nearest: Option<String>,
    },
    /// The parameter does not take that value.
    #[error("{}", with_group(group, source))]
    Value {
        /// Group of the parameter.
        group: &'static str,
        /// What is wrong with the value.
        source: ParamError,
    },
    /// The month does not have that day.
    #[error("`sun.day` = {day} is outside 1 to {days}, the days of {year}-{month:02}")]
    Day {
        /// Year of the date.
        year: u32,
        /// Month of the date.
        month: u32,
        /// Day that the month does not have.
        day: u32,
        /// Number of days in the month.
        days: u32,
    },
    /// Ozone is densest where there is no atmosphere.
    #[error(
        "`atmosphere.ozone_altitude_km` = {ozone_altitude_km} km is above `atmosphere.top_altitude_km` = \
         {top_altitude_km} km; lower the ozone or set `atmosphere.ozone_du` to 0"
    )]
    OzoneAboveTop {
        /// Altitude of the densest ozone.
        ozone_altitude_km: f64,
        /// Top of the atmosphere.
        top_altitude_km: f64,
    },
    /// The algorithm for the sun's position refused its input.
    #[error("the sun's position cannot be computed: {reason}")]
    SunPosition {
        /// The algorithm's own words.
        reason: String,
    },
}

impl SceneError {
    /// Path of the parameter that is wrong (`sun.elevation_deg`), where one can be named.
    #[must_use]
    pub fn field(&self) -> Option<String> {
        match self {
            Self::UnknownGroup { name, .. } => Some(name.clone()),
            Self::UnknownParameter { path, .. } => Some(path.clone()),
            Self::Value { group, source } => Some(format!("{group}.{}", name_of(source))),
            Self::Day { .. } => Some("sun.day".to_owned()),
            Self::OzoneAboveTop { .. } => Some("atmosphere.ozone_altitude_km".to_owned()),
            Self::SunPosition { .. } => Some("sun.position".to_owned()),
        }
    }
}

fn hint(nearest: Option<&str>) -> String {
    nearest.map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}

fn name_of(error: &ParamError) -> &str {
    match error {
        ParamError::Unknown { name } => name,
        ParamError::OutOfRange { name, .. }
        | ParamError::NotWhole { name, .. }
        | ParamError::WrongKind { name, .. } => name,
    }
}

fn with_group(group: &str, error: &ParamError) -> String {
    let name = name_of(error);
    error.to_string().replacen(&format!("`{name}`"), &format!("`{group}.{name}`"), 1)
}
