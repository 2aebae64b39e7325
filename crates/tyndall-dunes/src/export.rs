//! Grids for other programs: heights in metres, normals, ripple directions, masks, tiles with shared borders.

use crate::DuneError;
use crate::direction::tan_deg;
use crate::edges::Edges;
use crate::error::check_value;
use crate::measure::HeightGrid;
use crate::shadow::ShadowLine;
use crate::simulation::SandSimulation as _;
use crate::slab::{DUNE_QUANTA_PER_CELL, DuneField};

/// Slope that ripples fade away on (deg): from here to repose.
const FADE_FROM_DEG: f64 = 24.0;
/// Slope without ripples (deg), just below repose.
const FADE_TO_DEG: f64 = 31.0;

/// Everything that one may want of a field, x runs fastest, row 0 in the south.
#[derive(Clone, Debug, PartialEq)]
pub struct DuneMaps {
    /// Samples along x and y.
    pub size: [usize; 2],
    /// Distance of two samples (m).
    pub cell_m: f64,
    /// Heights (m).
    pub height_m: Vec<f32>,
    /// Depth of the sand (m).
    pub sand_m: Vec<f32>,
    /// Unit normals: east, north, up.
    pub normals: Vec<[f32; 3]>,
    /// Direction in which ripples travel: east, north; its length is their height, 0 where there are none to 1.
    pub ripples: Vec<[f32; 2]>,
    /// 1 in the lee of a crest, 0 in the wind.
    pub lee: Vec<u8>,
    /// 1 on slip faces.
    pub slip_face: Vec<u8>,
}

impl DuneMaps {
    /// The maps of a field whose cells are `cell_m` wide, under its wind of the next step.
    ///
    /// # Errors
    /// [`DuneError::Value`] when `cell_m` is not 0.01 to 100 m.
    pub fn of(field: &DuneField, cell_m: f64) -> Result<Self, DuneError> {
        check_value("width of a cell", cell_m, " m", 0.01..=100.0)?;
        let size = field.lattice().size();
        let metres = |quanta: i32| (f64::from(quanta) * cell_m / f64::from(DUNE_QUANTA_PER_CELL)) as f32;
        let bed = HeightGrid::from_quanta(size, field.heights(), DUNE_QUANTA_PER_CELL).ok_or(DuneError::GridSize {
            what: "the bed",
            found: field.heights().len(),
            size,
        })?;
        let lee = lee(field);
        let surface = gradients(&bed, field.edges());
        let wind = field.winds().direction(field.steps_done());
        let wind = [wind.x, wind.y].map(|part| f64::from(part) / f64::from(crate::direction::DIRECTION_ONE));
        let bare = field.heights().iter().zip(field.bedrock()).map(|(height, rock)| height - rock < field.rule().slab);
        let rule = RippleRule::new();
        let ripple = |((&slope, &lee), bare): ((&[f64; 2], &u8), bool)| {
            if lee != 0 || bare { [0.0, 0.0] } else { rule.ripple(slope, wind) }
        };
        let slip = tan_deg(28.0);
        Ok(Self {
            size,
            cell_m,
            height_m: field.heights().iter().map(|&height| metres(height)).collect(),
            sand_m: field.heights().iter().zip(field.bedrock()).map(|(height, rock)| metres(height - rock)).collect(),
            normals: surface.iter().copied().map(normal).collect(),
            ripples: surface.iter().zip(&lee).zip(bare).map(ripple).collect(),
            slip_face: surface
                .iter()
                .zip(&lee)
                .map(|(&[x, y], &lee)| u8::from(lee != 0 && x * x + y * y > slip * slip))
                .collect(),
            lee,
        })
    }

    /// Lowest and highest height (m).
    #[must_use]
    pub fn height_range_m(&self) -> [f32; 2] {
        let (low, high) =
            self.height_m.iter().fold((f32::MAX, f32::MIN), |(low, high), &height| (low.min(height), high.max(height)));
        [low, high]
    }
}

/// Slopes of all cells along x and y.
fn gradients(bed: &HeightGrid, edges: Edges) -> Vec<[f64; 2]> {
    match edges {
        Edges::Periodic => (0..bed.size()[1]).flat_map(|y| bed.row_gradients(y)).collect(),
        Edges::Open => bed.cells().map(|cell| one_sided_gradient(bed, cell)).collect(),
    }
}

/// Slope along x and y; one-sided at the edges.
fn one_sided_gradient(bed: &HeightGrid, [x, y]: [isize; 2]) -> [f64; 2] {
    let [nx, ny] = bed.size().map(usize::cast_signed);
    let ([left, right], [down, up]) =
        ([x - 1, x + 1].map(|x| x.clamp(0, nx - 1)), [y - 1, y + 1].map(|y| y.clamp(0, ny - 1)));
    [
        (bed.at(right, y) - bed.at(left, y)) / (right - left) as f64,
        (bed.at(x, up) - bed.at(x, down)) / (up - down) as f64,
    ]
}

fn normal([x, y]: [f64; 2]) -> [f32; 3] {
    let length = (1.0 + x * x + y * y).sqrt();
    [-x / length, -y / length, 1.0 / length].map(|part| part as f32)
}

fn lee(field: &DuneField) -> Vec<u8> {
    let mut line = ShadowLine::new(field.lattice());
    let wind = field.winds().direction(field.steps_done());
    line.cast(field.heights(), wind, field.rule().shadow_fall, crate::slab::SHADOW_REACH_CELLS, field.edges());
    line.heights().iter().zip(field.heights()).map(|(line, height)| u8::from(line > height)).collect()
}

/// Tangents of the slopes that decide about ripples.
struct RippleRule {
    repose: f64,
    /// From where ripples fade, and where there are none.
    fade: [f64; 2],
}

impl RippleRule {
    fn new() -> Self {
        Self { repose: tan_deg(33.0), fade: [FADE_FROM_DEG, FADE_TO_DEG].map(tan_deg) }
    }

    /// Direction and height of ripples: grains follow the pull of the wind and of gravity down the slope, which are equal
    /// where the slope is at repose.
    fn ripple(&self, slope: [f64; 2], wind: [f64; 2]) -> [f32; 2] {
        let square = |[x, y]: [f64; 2]| x * x + y * y;
        let length = |vector| square(vector).sqrt();
        let pull = [0, 1].map(|axis| wind[axis] * self.repose - slope[axis]);
        let [from, to] = self.fade;
        let share = ((to - length(slope)) / (to - from)).clamp(0.0, 1.0);
        let height = share * share * (3.0 - 2.0 * share);
        if length(pull) > 1e-9 { pull.map(|part| (part / length(pull) * height) as f32) } else { [0.0, 0.0] }
    }
}

/// A part of a map with its borders.
#[derive(Clone, Debug, PartialEq)]
pub struct Tile<T> {
    /// Column and row of the tile among the tiles.
    pub place: [usize; 2],
    /// Samples along x and y: one more than cells, so that neighbours share their border.
    pub size: [usize; 2],
    /// Samples, x runs fastest.
    pub samples: Vec<T>,
}

/// Cuts a map into `count` = [columns, rows] tiles of equal size. The last sample of a tile is the first of the next one;
/// beyond the last column and row a periodic map begins again, an open one repeats its border. One tile is the map with
/// size + 1.
///
/// # Errors
/// [`DuneError::Value`] when a side is not a multiple of its number of tiles; [`DuneError::GridSize`] when the map has
/// another number of samples.
pub fn tiles<T: Copy>(map: &[T], size: [usize; 2], count: [usize; 2], edges: Edges) -> Result<Vec<Tile<T>>, DuneError> {
    if map.len() != size[0] * size[1] {
        return Err(DuneError::GridSize { what: "the map", found: map.len(), size });
    }
    for axis in [0, 1] {
        if count[axis] == 0 || !size[axis].is_multiple_of(count[axis]) {
            let what =
                ["number of tile columns, which divides the width,", "number of tile rows, which divides the height,"]
                    [axis];
            return Err(DuneError::Value {
                what,
                value: count[axis] as f64,
                unit: "",
                low: 1.0,
                high: size[axis] as f64,
            });
        }
    }
    let cells = [size[0] / count[0], size[1] / count[1]];
    let wrap = |index: usize, axis: usize| match edges {
        Edges::Periodic => index % size[axis],
        Edges::Open => index.min(size[axis] - 1),
    };
    let tile = |column: usize, row: usize| {
        let [left, bottom] = [column * cells[0], row * cells[1]];
        let rows = bottom..=bottom + cells[1];
        let sample = |y: usize| (left..=left + cells[0]).map(move |x| map[wrap(y, 1) * size[0] + wrap(x, 0)]);
        Tile { place: [column, row], size: cells.map(|side| side + 1), samples: rows.flat_map(sample).collect() }
    };
    Ok((0..count[1]).flat_map(|row| (0..count[0]).map(move |column| tile(column, row))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slab::DuneParams;

    fn maps() -> DuneMaps {
        let mut field = DuneField::with_size(&DuneParams::default(), [128, 64]).unwrap();
        field.run(600);
        field.settle();
        DuneMaps::of(&field, 2.0).unwrap()
    }

    #[test]
    fn normals_are_those_of_the_exported_heights() {
        let maps = maps();
        for (x, y) in [(0, 0), (17, 40), (127, 63), (64, 1)] {
            let at = |x: usize, y: usize| f64::from(maps.height_m[(y % 64) * 128 + x % 128]);
            let dx = (at(x + 1, y) - at(x + 127, y)) / (2.0 * maps.cell_m);
            let dy = (at(x, y + 1) - at(x, y + 63)) / (2.0 * maps.cell_m);
            let [nx, ny, nz] = maps.normals[y * 128 + x].map(f64::from);
            let cosine = (nz - nx * dx - ny * dy) / (1.0 + dx * dx + dy * dy).sqrt();
            assert!(cosine > 1.0 - 1e-6, "({x}, {y}): {cosine}");
        }
    }

    #[test]
    fn slip_faces_have_no_ripples_and_lie_in_the_lee() {
        let maps = maps();
        let count = maps.slip_face.iter().filter(|&&slip| slip != 0).count();
        assert!(count > 20, "there are slip faces: {count} cells");
        for (index, &slip) in maps.slip_face.iter().enumerate() {
            if slip != 0 {
                assert_eq!((maps.lee[index], maps.ripples[index]), (1, [0.0, 0.0]), "cell {index}");
            }
        }
        let windy = maps.ripples.iter().filter(|ripple| ripple[0] > 0.9).count();
        assert!(windy > maps.ripples.len() / 4, "ripples run with the wind on {windy} cells");
    }

    #[test]
    fn tiles_share_their_borders() {
        let map: Vec<u32> = (0..64 * 32).collect();
        let cut = tiles(&map, [64, 32], [4, 2], Edges::Periodic).unwrap();
        assert_eq!(cut.len(), 8, "four columns, two rows");
        let column =
            |tile: &Tile<u32>, x: usize| -> Vec<u32> { tile.samples.chunks_exact(17).map(|row| row[x]).collect() };
        for row in [0, 1] {
            for place in 0..4 {
                let (tile, next) = (&cut[row * 4 + place], &cut[row * 4 + (place + 1) % 4]);
                assert_eq!(column(tile, 16), column(next, 0), "tile {place} of row {row} and the next");
            }
        }
        assert_eq!(cut[0].samples[16 * 17..], cut[4].samples[..17], "rows share theirs");
        let message = tiles(&map, [64, 32], [3, 1], Edges::Open).unwrap_err().to_string();
        assert_eq!(
            message, "number of tile columns, which divides the width, = 3 is outside 1 to 64",
            "names the number"
        );
    }
}
