//! Everything that can be wrong with a scene.

use std::{io, path::PathBuf};

use tyndall_clouds::CloudError;
use tyndall_core::ParamError;
use tyndall_dunes::DuneError;

use crate::{Place, file, scene::MOST_CLOUD_CELLS};

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
    /// The air alone hides things nearer than the visibility that was asked for.
    #[error(
        "`atmosphere.aerosol_visibility_km` = {visibility_km} km is farther than the air without any aerosol allows, \
         {clearest_km:.0} km; lower it or `atmosphere.air_density`"
    )]
    VisibilityBeyondAir {
        /// Visibility that was asked for.
        visibility_km: f64,
        /// Visibility of the air alone.
        clearest_km: f64,
    },
    /// More cells of cloud than a frame can hold.
    #[error(
        "`cloud_grid.cells_east` x `cells_north` x `cells_up` = {} x {} x {} cells is more than {MOST_CLOUD_CELLS}, the \
         most that a picture takes; lower one of them",
        .size[0], .size[1], .size[2]
    )]
    CloudCells {
        /// Cells east, north and up.
        size: [u32; 3],
    },
    /// The clouds' parameters do not fit together, or a state of clouds is not that of this scene.
    #[error(transparent)]
    Clouds(#[from] CloudError),
    /// Steps were asked of a scene in which nothing moves.
    #[error("nothing in the scene goes on in steps; `clouds.kind` = \"automaton\" and `desert.kind` = \"dunes\" do")]
    NothingMoves,
    /// The desert's parameters do not fit together, or a state of sand is not that of this scene.
    #[error(transparent)]
    Sand(#[from] DuneError),
    /// Two grounds at one place.
    #[error(
        "`desert.kind` = \"dunes\" and `landscape.kind` = {landscape:?} are two grounds at one place; set one of them to \
         \"none\""
    )]
    DesertAndLandscape {
        /// The landscape's kind.
        landscape: &'static str,
    },
    /// A height map whose lowest place is its highest.
    #[error("`desert.terrain_low_m` = {low_m} m is above `desert.terrain_high_m` = {high_m} m; lower it")]
    TerrainRange {
        /// Height of the darkest sample.
        low_m: f64,
        /// Height of the brightest sample.
        high_m: f64,
    },
    /// A desert before an orthographic camera.
    #[error(
        "camera.projection = \"orthographic\" shows no desert; set desert.kind to \"none\" or the projection to \
         \"perspective\""
    )]
    OrthographicDesert,
    /// Several things go on in steps, and it is not said which is meant.
    #[error("both clouds and sand of the scene go on in steps; say which is meant: clouds or desert")]
    SeveralMove,
    /// A simulation was named that the scene does not have.
    #[error("the scene has no {named} that goes on in steps, only {present}")]
    NotSimulated {
        /// What was named.
        named: &'static str,
        /// What there is.
        present: &'static str,
    },
    /// A state of something else.
    #[error("the state is one of {state}, which {scene} cannot start from")]
    StateOfOther {
        /// What the state is one of.
        state: &'static str,
        /// What was to start from it.
        scene: &'static str,
    },
    /// A landscape before an orthographic camera.
    #[error(
        "camera.projection = \"orthographic\" shows no landscape; set landscape.kind to \"none\" or the projection to \
         \"perspective\""
    )]
    OrthographicLandscape,
    /// The algorithm for the sun's position refused its input.
    #[error("the sun's position cannot be computed: {reason}")]
    SunPosition {
        /// The algorithm's own words.
        reason: String,
    },
    /// A value of another type than the parameter's.
    #[error("`{path}`{} is {found}, not {expected}", equals(text))]
    WrongType {
        /// Path of the parameter or the group.
        path: String,
        /// The value as the user wrote it; its beginning when it is long, nothing when it is a table.
        text: String,
        /// Type of the value, with its article.
        found: String,
        /// What would be allowed.
        expected: String,
    },
    /// The file does not say which format it is in.
    #[error("`format` is missing; a scene file begins with `format = {}`", file::FORMAT)]
    FormatMissing,
    /// The file is in a format that this version does not know.
    #[error("`format` = {found} is not known; this version reads format {}{}", file::FORMAT, newer(*found))]
    FormatUnknown {
        /// The format that the file names.
        found: i64,
    },
    /// The file is not TOML.
    #[error("{message}{}{}", within(field.as_deref()), takes(expected.as_deref()))]
    Syntax {
        /// What the reader of TOML met.
        message: String,
        /// The key on whose line it happened, or the table.
        field: Option<String>,
        /// What the parameter on that line takes.
        expected: Option<String>,
    },
    /// The file is not UTF-8 text.
    #[error("not UTF-8 text; is this a scene file?")]
    NotText,
    /// The file is larger than any scene.
    #[error("{}: larger than {} bytes, the most that a scene file may have", path.display(), file::MAX_BYTES)]
    TooLarge {
        /// The file.
        path: PathBuf,
    },
    /// A folder was named where a file is needed.
    #[error("{}: is a folder, not a scene file", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
    },
    /// The file could not be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The file could not be written; what was there before is unchanged.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// Any of the above, at a place in a file.
    #[error("{place}: {problem}")]
    At {
        /// File, line and column.
        place: Box<Place>,
        /// What is wrong there.
        problem: Box<Self>,
    },
}

impl SceneError {
    /// Path of the parameter that is wrong (`sun.elevation_deg`), where one can be named.
    #[must_use]
    pub fn field(&self) -> Option<String> {
        self.fields().into_iter().next()
    }

    /// The place in the scene file, when the scene came from one.
    #[must_use]
    pub fn place(&self) -> Option<&Place> {
        if let Self::At { place, .. } = self { Some(place) } else { None }
    }

    /// The message for a terminal: with the line of the file and a caret under the place. No colours; ends in a line break.
    #[must_use]
    pub fn report(&self) -> String {
        match self {
            Self::At { place, problem } => format!("error: {problem}\n{}", place.excerpt()),
            other => format!("error: {other}\n"),
        }
    }

    /// The same error at a place in a file.
    pub(crate) fn at(self, place: Place) -> Self {
        Self::At { place: Box::new(place), problem: Box::new(self) }
    }

    /// Paths of all parameters that take part in the error, the one to blame first.
    pub(crate) fn fields(&self) -> Vec<String> {
        match self {
            Self::UnknownGroup { name, .. } => vec![name.clone()],
            Self::UnknownParameter { path, .. } | Self::WrongType { path, .. } => vec![path.clone()],
            Self::Value { group, source } => vec![format!("{group}.{}", name_of(source))],
            Self::Day { .. } => ["sun.day", "sun.month", "sun.year"].map(str::to_owned).to_vec(),
            Self::OzoneAboveTop { .. } => {
                ["atmosphere.ozone_altitude_km", "atmosphere.top_altitude_km"].map(str::to_owned).to_vec()
            }
            Self::VisibilityBeyondAir { .. } => {
                ["atmosphere.aerosol_visibility_km", "atmosphere.air_density"].map(str::to_owned).to_vec()
            }
            Self::CloudCells { .. } => {
                ["cloud_grid.cells_east", "cloud_grid.cells_north", "cloud_grid.cells_up"].map(str::to_owned).to_vec()
            }
            Self::DesertAndLandscape { .. } => ["desert.kind", "landscape.kind"].map(str::to_owned).to_vec(),
            Self::TerrainRange { .. } => ["desert.terrain_low_m", "desert.terrain_high_m"].map(str::to_owned).to_vec(),
            Self::OrthographicDesert => ["camera.projection", "desert.kind"].map(str::to_owned).to_vec(),
            Self::OrthographicLandscape => ["camera.projection", "landscape.kind"].map(str::to_owned).to_vec(),
            Self::SunPosition { .. } => vec!["sun.position".to_owned()],
            Self::NothingMoves | Self::SeveralMove | Self::NotSimulated { .. } | Self::StateOfOther { .. } => {
                ["clouds.kind", "desert.kind"].map(str::to_owned).to_vec()
            }
            Self::FormatMissing | Self::FormatUnknown { .. } => vec!["format".to_owned()],
            Self::Syntax { field, .. } => field.iter().cloned().collect(),
            Self::At { problem, .. } => problem.fields(),
            Self::Clouds(_)
            | Self::Sand(_)
            | Self::NotText
            | Self::TooLarge { .. }
            | Self::Folder { .. }
            | Self::Read { .. }
            | Self::Write { .. } => vec![],
        }
    }
}

fn newer(found: i64) -> &'static str {
    if found > file::FORMAT { "; a newer version of Tyndall wrote this file" } else { "" }
}

fn equals(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!(" = {text}") }
}

fn takes(expected: Option<&str>) -> String {
    expected.map_or(String::new(), |expected| format!(", which takes {expected}"))
}

fn within(field: Option<&str>) -> String {
    field.map_or(String::new(), |field| format!(", in `{field}`"))
}

fn hint(nearest: Option<&str>) -> String {
    nearest.map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}

fn name_of(error: &ParamError) -> &str {
    match error {
        ParamError::Unknown { name } => name,
        ParamError::OutOfRange { name, .. }
        | ParamError::NotWhole { name, .. }
        | ParamError::WrongKind { name, .. }
        | ParamError::Text { name, .. }
        | ParamError::IsText { name } => name,
    }
}

fn with_group(group: &str, error: &ParamError) -> String {
    let name = name_of(error);
    error.to_string().replacen(&format!("`{name}`"), &format!("`{group}.{name}`"), 1)
}
