//! What the desert of a scene takes from files: the rock under the sand and measured winds.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tyndall_io::{HeightScale, IoError, read_height_map};
use tyndall_scene::{DesertInputs, DesertKind, Scene};

use tyndall_dunes::terrain::Terrain;
use tyndall_dunes::wind::WindSchedule;
use tyndall_dunes::wind_rose::{WindRose, threshold_speed_m_s};
use tyndall_dunes::{DuneError, by_hand};

/// Most bytes of a table of winds: a century of hourly ones.
const MOST_TABLE_BYTES: u64 = 1 << 26;

/// Why a file of the desert was refused.
#[derive(Debug, thiserror::Error)]
pub enum DesertFileError {
    /// The height map cannot be read.
    #[error("desert.terrain: {0}")]
    Terrain(Box<IoError>),
    /// What was written by hand cannot be used.
    #[error(transparent)]
    ByHand(#[from] DuneError),
    /// The table of winds cannot be read.
    #[error("desert.wind_table: {}: {problem}", path.display())]
    WindTable {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        problem: String,
    },
}

/// Reads what the scene's desert takes from files; nothing without a desert.
///
/// # Errors
/// When a file cannot be read or is not what it should be, with its name and the reason.
pub fn desert_inputs(scene: &Scene) -> Result<DesertInputs, DesertFileError> {
    if scene.desert.kind == DesertKind::None {
        return Ok(DesertInputs::default());
    }
    let terrain = scene.terrain_file().map(|path| terrain(scene, &path)).transpose()?;
    let measured = scene.wind_table_file().map(|path| winds(scene, &path)).transpose()?;
    let by_hand = by_hand::parse_winds(&scene.desert.winds)?;
    let by_hand = || WindSchedule::new(&by_hand, scene.dune_wind.period_steps);
    let winds = match measured {
        None if !scene.desert.winds.is_empty() => Some(by_hand()?),
        measured => measured,
    };
    let strokes = by_hand::parse_strokes(&scene.desert.strokes)?;
    let touches = by_hand::touches(&strokes, scene.dunes.cell_m, [scene.dunes.side.cells(); 2])?;
    Ok(DesertInputs { terrain: terrain.map(Arc::new), winds, touches })
}

#[expect(clippy::cast_possible_truncation, reason = "heights are kept as f32")]
fn terrain(scene: &Scene, path: &Path) -> Result<Terrain, DesertFileError> {
    let range_m = [scene.desert.terrain_low_m, scene.desert.terrain_high_m].map(|height| height as f32);
    let scale = HeightScale { range_m, pixel_m: scene.dunes.cell_m };
    let map = read_height_map(path, scale).map_err(|error| DesertFileError::Terrain(Box::new(error)))?;
    Ok(Terrain { size: map.size_px.map(|side| side as usize), height_m: map.heights_m })
}

fn winds(scene: &Scene, path: &Path) -> Result<WindSchedule, DesertFileError> {
    let refused = |problem: String| DesertFileError::WindTable { path: path.to_path_buf(), problem };
    let bytes = std::fs::metadata(path).map_err(|error| refused(format!("cannot be read: {error}")))?.len();
    if bytes > MOST_TABLE_BYTES {
        return Err(refused(format!("it has {bytes} bytes; {MOST_TABLE_BYTES} are allowed")));
    }
    let table = std::fs::read_to_string(path).map_err(|error| refused(format!("cannot be read: {error}")))?;
    let rose = WindRose::parse_csv(&table).map_err(|error| refused(error.to_string()))?;
    let (sectors, threshold_m_s) = (scene.desert.wind_sectors as usize, threshold_speed_m_s(scene.desert.grain_um));
    rose.schedule(sectors, threshold_m_s, scene.dune_wind.period_steps).map_err(|error| match error {
        DuneError::NoWind => refused(format!("no wind of it is above {threshold_m_s:.1} m/s, which moves this sand")),
        other => refused(other.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(folder: &Path) -> Scene {
        let mut scene = Scene { folder: folder.to_path_buf().into(), ..Scene::default() };
        scene.desert.kind = DesertKind::Dunes;
        scene
    }

    #[test]
    fn terrain_and_winds_come_from_the_named_files() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = scene(folder.path());
        assert_eq!(desert_inputs(&scene).unwrap(), DesertInputs::default(), "none are named");
        let bytes: Vec<u8> = [0_u16, 65535, 0, 0].into_iter().flat_map(u16::to_le_bytes).collect();
        std::fs::write(folder.path().join("rock.r16"), bytes).unwrap();
        std::fs::write(folder.path().join("winds.csv"), "direction_deg,speed_m_s\n270,12\n").unwrap();
        (scene.desert.terrain, scene.desert.wind_table) = ("rock.r16".to_owned(), "winds.csv".to_owned());
        let inputs = desert_inputs(&scene).unwrap();
        let terrain = inputs.terrain.unwrap();
        assert_eq!((terrain.size, &terrain.height_m[..]), ([2, 2], &[0.0, 0.0, 0.0, 50.0][..]), "north first in files");
        let winds = inputs.winds.unwrap();
        assert_eq!((winds.winds().len(), winds.winds()[0].toward_deg.to_bits()), (1, 0_f64.to_bits()), "from the west");
    }

    #[test]
    fn files_that_are_not_what_they_should_be_are_refused_by_name() {
        let folder = tempfile::tempdir().unwrap();
        let mut scene = scene(folder.path());
        scene.desert.terrain = "rock.r16".to_owned();
        let text = desert_inputs(&scene).unwrap_err().to_string();
        assert!(text.starts_with("desert.terrain: ") && text.contains("rock.r16"), "{text}");
        scene.desert.terrain.clear();
        scene.desert.wind_table = "winds.csv".to_owned();
        std::fs::write(folder.path().join("winds.csv"), "direction_deg,speed_m_s\n270,3\n").unwrap();
        let text = desert_inputs(&scene).unwrap_err().to_string();
        assert!(text.contains("winds.csv: no wind of it is above 8.1 m/s"), "{text}");
    }
}
