//! Brushes: sand by hand, booked in the ledger.

use crate::DuneError;
use crate::error::check_value;
use crate::simulation::SandSimulation as _;
use crate::slab::{DUNE_QUANTA_PER_CELL, DuneField, MAX_HEIGHT_CELLS};

/// Largest radius of a brush (cells).
pub const MAX_RADIUS_CELLS: f64 = 512.0;
/// Length of a footprint over its width.
const FOOT_LENGTH: f64 = 2.6;
/// Distance between the prints of a trail, in widths of a foot.
const PACE: f64 = 5.0;
/// Distance of each print from the middle of the trail, in widths of a foot.
const STRADDLE: f64 = 0.8;

/// What a brush does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Brush {
    /// Puts sand down: so deep in the middle (cells), less towards the rim.
    Add(f64),
    /// Takes sand away: so deep in the middle (cells), as far as there is any.
    Dig(f64),
    /// Moves the bed towards its mean height under the brush, by this share (0 to 1) in the middle.
    Flatten(f64),
    /// Presses a foot in: so deep (cells); the sand goes to a rim around it. The radius is half the foot's width; it points
    /// in this direction, anticlockwise from +x (deg).
    Footprint {
        /// Depth (cells).
        depth_cells: f64,
        /// Where the toes point (deg).
        toward_deg: f64,
    },
}

/// One touch of a brush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// What it does.
    pub brush: Brush,
    /// Middle (cells) from the corner of the bed.
    pub center_cells: [f64; 2],
    /// Radius (cells).
    pub radius_cells: f64,
}

impl DuneField {
    /// Touches the bed; beyond periodic edges the stroke comes in on the other side, beyond open ones it is cut off.
    /// Gives back the change of all sand (quanta), which the ledger has booked.
    ///
    /// # Errors
    /// [`DuneError::Value`] when a number of the stroke is not finite or out of range; the bed is as it was then.
    pub fn apply(&mut self, stroke: &Stroke) -> Result<i64, DuneError> {
        check_stroke(stroke)?;
        let before = self.ledger();
        match stroke.brush {
            Brush::Add(depth_cells) => self.pile(stroke, depth_cells),
            Brush::Dig(depth_cells) => self.pile(stroke, -depth_cells),
            Brush::Flatten(share) => self.flatten(stroke, share),
            Brush::Footprint { depth_cells, toward_deg } => self.press(stroke, depth_cells, toward_deg),
        }
        self.look_around();
        let after = self.ledger();
        Ok(after.brushed_on - before.brushed_on - after.brushed_off + before.brushed_off)
    }

    /// Footprints along a path of points (cells), left and right in turn; gives back their number.
    ///
    /// # Errors
    /// As [`DuneField::apply`]; prints before the refused one stay.
    pub fn apply_trail(
        &mut self,
        path_cells: &[[f64; 2]],
        radius_cells: f64,
        depth_cells: f64,
    ) -> Result<u32, DuneError> {
        for leg in path_cells.windows(2) {
            let length = (leg[1][0] - leg[0][0]).hypot(leg[1][1] - leg[0][1]);
            check_value("length of a leg of a trail", length, " cells", 0.0..=1e5)?;
        }
        let prints = trail(path_cells, radius_cells, depth_cells);
        prints.iter().try_for_each(|print| self.apply(print).map(|_change| ()))?;
        Ok(prints.len() as u32)
    }

    /// Cells within `reach` of the middle: index, and offset of the cell's middle from that of the brush.
    fn touched(&self, center_cells: [f64; 2], reach: f64) -> Vec<(usize, [f64; 2])> {
        let range = |axis: usize| {
            let [low, high] = [center_cells[axis] - reach, center_cells[axis] + reach].map(|edge| edge.floor() as i32);
            low..=high
        };
        let lattice = self.lattice();
        let cells = range(1).flat_map(|y| range(0).map(move |x| [x, y]));
        let inside = cells.filter(|&[x, y]| self.edges() == crate::Edges::Periodic || !lattice.is_outside(x, y));
        let offset = |x: i32, axis: usize| f64::from(x) + 0.5 - center_cells[axis];
        inside.map(|[x, y]| (lattice.index(x, y), [offset(x, 0), offset(y, 1)])).collect()
    }

    /// Changes the sand of a cell as far as there is sand and room; gives back what changed (quanta).
    fn change_cell(&mut self, index: usize, change: i32) -> i32 {
        let room = MAX_HEIGHT_CELLS * DUNE_QUANTA_PER_CELL - self.heights[index];
        let change = change.max(self.bedrock[index] - self.heights[index]).min(room.max(0));
        self.heights[index] += change;
        if change > 0 {
            self.ledger.brushed_on += i64::from(change);
        } else {
            self.ledger.brushed_off -= i64::from(change);
        }
        change
    }

    fn pile(&mut self, stroke: &Stroke, depth_cells: f64) {
        for (index, offset) in self.touched(stroke.center_cells, stroke.radius_cells) {
            let depth = depth_cells * falloff(offset, stroke.radius_cells);
            self.change_cell(index, quanta(depth));
        }
    }

    fn flatten(&mut self, stroke: &Stroke, share: f64) {
        let cells = self.touched(stroke.center_cells, stroke.radius_cells);
        let cells: Vec<_> =
            cells.into_iter().map(|(index, offset)| (index, falloff(offset, stroke.radius_cells))).collect();
        let weight: f64 = cells.iter().map(|(_, weight)| weight).sum();
        let mean = cells.iter().map(|&(index, weight)| weight * f64::from(self.heights[index])).sum::<f64>()
            / weight.max(1e-9);
        for (index, weight) in cells {
            let change = share * weight * (mean - f64::from(self.heights[index]));
            self.change_cell(index, change.round() as i32);
        }
    }

    fn press(&mut self, stroke: &Stroke, depth_cells: f64, toward_deg: f64) {
        let (sin, cos) = toward_deg.to_radians().sin_cos();
        let reach = 1.8 * FOOT_LENGTH * stroke.radius_cells;
        let shape = |[x, y]: [f64; 2]| {
            let [along, across] = [x * cos + y * sin, y * cos - x * sin];
            (along / (FOOT_LENGTH * stroke.radius_cells)).hypot(across / stroke.radius_cells)
        };
        let mut rim = Vec::new();
        let mut pressed = 0_i64;
        for (index, offset) in self.touched(stroke.center_cells, reach) {
            let distance = shape(offset);
            if distance < 1.0 {
                let depth = depth_cells * (1.0 - distance.powi(4));
                pressed -= i64::from(self.change_cell(index, -quanta(depth)));
            } else if distance < 1.6 {
                rim.push(index);
            }
        }
        // What the foot displaced, evenly on the rim; the remainder one quantum each on its first cells.
        let count = rim.len().max(1) as i64;
        for (place, index) in (0..).zip(rim) {
            self.change_cell(index, (pressed / count + i64::from(place < pressed % count)) as i32);
        }
    }
}

/// A place on a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathStep {
    /// The place.
    pub(crate) place: [f64; 2],
    /// Direction of the path there, of length 1.
    along: [f64; 2],
}

/// Places on a path, one after the other at this distance, the first one at its start.
pub(crate) fn walk(path: &[[f64; 2]], pace: f64) -> Vec<PathStep> {
    let (mut steps, mut walked) = (Vec::new(), 0.0);
    for leg in path.windows(2) {
        let [dx, dy] = [leg[1][0] - leg[0][0], leg[1][1] - leg[0][1]];
        let length = dx.hypot(dy);
        while walked < length {
            let share = walked / length;
            let place = [leg[0][0] + share * dx, leg[0][1] + share * dy];
            steps.push(PathStep { place, along: [dx / length, dy / length] });
            walked += pace;
        }
        walked -= length;
    }
    steps
}

/// Footprints along a path, left and right in turn (cells).
pub(crate) fn trail(path_cells: &[[f64; 2]], radius_cells: f64, depth_cells: f64) -> Vec<Stroke> {
    let steps = walk(path_cells, 2.0 * radius_cells * PACE).into_iter().enumerate();
    let print = |(index, PathStep { place, along: [dx, dy] }): (usize, PathStep)| {
        let side = if index.is_multiple_of(2) { STRADDLE } else { -STRADDLE } * 2.0 * radius_cells;
        let brush = Brush::Footprint { depth_cells, toward_deg: dy.atan2(dx).to_degrees() };
        Stroke { brush, center_cells: [place[0] - dy * side, place[1] + dx * side], radius_cells }
    };
    steps.map(print).collect()
}

fn quanta(cells: f64) -> i32 {
    (cells * f64::from(DUNE_QUANTA_PER_CELL)).round() as i32
}

/// 1 in the middle, 0 at the rim, smooth at both.
fn falloff([x, y]: [f64; 2], radius: f64) -> f64 {
    let share = (1.0 - (x * x + y * y) / (radius * radius)).max(0.0);
    share * share
}

/// That a stroke's numbers are in range.
pub(crate) fn check_stroke(stroke: &Stroke) -> Result<(), DuneError> {
    for center in stroke.center_cells {
        check_value("position of a brush", center, " cells", -1e6..=1e6)?;
    }
    check_value("radius of a brush", stroke.radius_cells, " cells", 0.1..=MAX_RADIUS_CELLS)?;
    match stroke.brush {
        Brush::Add(depth) | Brush::Dig(depth) => check_value("depth of a brush", depth, " cells", 0.0..=1000.0)?,
        Brush::Flatten(share) => check_value("share of a flattening brush", share, "", 0.0..=1.0)?,
        Brush::Footprint { depth_cells, toward_deg } => {
            check_value("direction of a footprint", toward_deg, " deg", -1e4..=1e4)?;
            check_value("depth of a footprint", depth_cells, " cells", 0.0..=1000.0)?
        }
    };
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slab::DuneParams;

    fn field() -> DuneField {
        DuneField::with_size(&DuneParams { noise_cells: 0.0, ..DuneParams::default() }, [64, 64]).unwrap()
    }

    fn stroke(brush: Brush) -> Stroke {
        Stroke { brush, center_cells: [2.0, 60.0], radius_cells: 8.0 }
    }

    #[test]
    fn every_brush_keeps_the_ledger() {
        let mut field = field();
        let footprint = Brush::Footprint { depth_cells: 0.5, toward_deg: 30.0 };
        for brush in [Brush::Add(4.0), Brush::Dig(9.0), Brush::Flatten(0.7), footprint] {
            let before = field.mass_quanta();
            let change = field.apply(&stroke(brush)).unwrap();
            assert_eq!(field.mass_quanta() - before, change, "{brush:?}: what it says");
            assert_eq!(field.mass_quanta(), field.ledger().expected(), "{brush:?}: ledger");
            assert!(field.heights().iter().all(|&height| height >= 0), "{brush:?}: no hole in the bedrock");
        }
    }

    #[test]
    fn a_footprint_only_moves_sand() {
        let mut field = field();
        let brush = Brush::Footprint { depth_cells: 0.5, toward_deg: 70.0 };
        assert_eq!(field.apply(&stroke(brush)).unwrap(), 0, "from the sole to the rim");
        let lowest = field.heights().iter().min().copied().unwrap();
        assert!(lowest <= 3 * 256 - 110, "half a cell deep: {lowest}");
    }

    #[test]
    fn flattening_reduces_relief() {
        let mut field = field();
        field.apply(&stroke(Brush::Add(4.0))).unwrap();
        let top = |field: &DuneField| field.heights().iter().max().copied().unwrap();
        let before = top(&field);
        for _ in 0..4 {
            field.apply(&stroke(Brush::Flatten(1.0))).unwrap();
        }
        assert!(top(&field) < before - 256, "{} of {before}", top(&field));
    }

    #[test]
    fn a_trail_alternates_feet() {
        let mut field = field();
        let prints = field.apply_trail(&[[5.0, 32.0], [45.0, 32.0]], 1.0, 0.5).unwrap();
        assert_eq!(prints, 4, "a pace is 10 cells");
        let low = |y: usize| (0..64).filter(|x| field.heights()[y * 64 + x] < 3 * 256 - 60).count();
        assert!(low(33) > 0 && low(30) > 0 && low(40) == 0, "on both sides of the path: {} and {}", low(33), low(30));
    }

    #[test]
    fn impossible_strokes_are_refused() {
        let mut field = field();
        let before = field.state_hash();
        let mut wrong = stroke(Brush::Add(1.0));
        wrong.radius_cells = f64::NAN;
        let message = field.apply(&wrong).unwrap_err().to_string();
        assert_eq!(message, "radius of a brush = NaN cells is outside 0.1 to 512 cells", "names the value");
        assert!(field.apply(&stroke(Brush::Flatten(2.0))).is_err(), "a share above 1");
        assert_eq!(field.state_hash(), before, "nothing changed");
    }
}
