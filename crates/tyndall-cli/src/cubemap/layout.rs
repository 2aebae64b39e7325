//! How the six faces of a cube lie in one picture.

use tyndall_render::CubeFace;

/// Where the faces go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Layout {
    /// Six files: posx, negx, posy, negy, posz, negz
    Faces,
    /// One row in the order of a cube texture's layers
    Strip,
    /// Four columns, three rows; posz (north) in the second column of the second row
    CrossHorizontal,
    /// Three columns, four rows; negz (south) hangs below, turned by half a turn
    CrossVertical,
}

/// The place of a face: column and row, and whether it is turned by half a turn.
type Place = (CubeFace, [u32; 2], bool);

impl Layout {
    /// Columns and rows of faces; of one file's.
    #[must_use]
    pub fn grid(self) -> [u32; 2] {
        match self {
            Self::Faces => [1, 1],
            Self::Strip => [6, 1],
            Self::CrossHorizontal => [4, 3],
            Self::CrossVertical => [3, 4],
        }
    }

    fn places(self) -> [Place; 6] {
        use CubeFace::{NegX, NegY, NegZ, PosX, PosY, PosZ};
        let cross = |south: [u32; 2], turned: bool| {
            [
                (PosX, [2, 1], false),
                (NegX, [0, 1], false),
                (PosY, [1, 0], false),
                (NegY, [1, 2], false),
                (PosZ, [1, 1], false),
                (NegZ, south, turned),
            ]
        };
        match self {
            Self::Faces => CubeFace::ALL.map(|face| (face, [0, 0], false)),
            Self::Strip => {
                let mut column = 0..;
                CubeFace::ALL.map(|face| (face, [column.next().unwrap_or(0), 0], false))
            }
            Self::CrossHorizontal => cross([3, 1], false),
            Self::CrossVertical => cross([1, 3], true),
        }
    }

    /// One picture of all faces, which lie in the order of [`CubeFace::ALL`]; `empty` where none is.
    #[must_use]
    pub fn assemble<T: Copy>(self, faces: &[Vec<T>], side_px: u32, empty: T) -> Vec<T> {
        let [columns, rows] = self.grid();
        let (side, stride) = (side_px as usize, (columns * side_px) as usize);
        let mut picture = vec![empty; stride * (rows * side_px) as usize];
        for ((_, [column, row], turned), face) in self.places().into_iter().zip(faces) {
            let first = row as usize * side * stride + column as usize * side;
            for (y, pixels) in face.chunks_exact(side).enumerate() {
                let line = if turned { side - 1 - y } else { y };
                let target = &mut picture[first + line * stride..][..side];
                target.copy_from_slice(pixels);
                if turned {
                    target.reverse();
                }
            }
        }
        picture
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Faces of 2 x 2 pixels, each pixel with a number of its own.
    fn faces() -> [Vec<u32>; 6] {
        [0, 10, 20, 30, 40, 50].map(|first| (first..first + 4).collect())
    }

    #[test]
    fn every_pixel_of_every_face_is_in_each_layout_once() {
        for layout in [Layout::Strip, Layout::CrossHorizontal, Layout::CrossVertical] {
            let picture = layout.assemble(&faces(), 2, u32::MAX);
            let mut found: Vec<_> = picture.into_iter().filter(|pixel| *pixel != u32::MAX).collect();
            found.sort_unstable();
            assert_eq!(found, faces().concat(), "{layout:?}");
        }
    }

    #[test]
    fn crosses_lie_as_a_cube_unfolds() {
        let none = u32::MAX;
        let horizontal = Layout::CrossHorizontal.assemble(&faces(), 2, none);
        assert_eq!(horizontal[..8], [none, none, 20, 21, none, none, none, none], "the zenith above the north");
        assert_eq!(horizontal[16..24], [10, 11, 40, 41, 0, 1, 50, 51], "west, north, east, south");
        let vertical = Layout::CrossVertical.assemble(&faces(), 2, none);
        assert_eq!(vertical[12..18], [10, 11, 40, 41, 0, 1], "west, north, east");
        assert_eq!(vertical[36..42], [none, none, 53, 52, none, none], "the south upside down");
    }
}
