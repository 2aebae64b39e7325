//! The cloud automaton as most programs write it: a byte per cell, bounds checks, a float per draw.

/// State of the naive automaton.
pub(crate) struct NaiveClouds {
    size: [usize; 3],
    hum: Vec<u8>,
    act: Vec<u8>,
    cld: Vec<u8>,
    random: u64,
}

/// Neighbours whose activation spreads.
const NEIGHBOURS: [[isize; 3]; 11] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [-1, 0, 0],
    [0, -1, 0],
    [0, 0, -1],
    [-2, 0, 0],
    [2, 0, 0],
    [0, -2, 0],
    [0, 2, 0],
    [0, 0, -2],
];

impl NaiveClouds {
    pub(crate) fn new(size: [usize; 3]) -> Self {
        let cells = size.iter().product();
        let mut naive =
            Self { size, hum: vec![1; cells], act: vec![0; cells], cld: vec![0; cells], random: 0x9E37_79B9_7F4A_7C15 };
        for cell in 0..cells {
            naive.act[cell] = u8::from(naive.draw() < 0.001);
        }
        naive
    }

    /// Number of cloud cells, so that nothing is optimised away.
    pub(crate) fn cloud(&self) -> usize {
        self.cld.iter().map(|cell| usize::from(*cell)).sum()
    }

    fn draw(&mut self) -> f32 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 7;
        self.random ^= self.random << 17;
        (self.random >> 40) as f32 / 16_777_216.0
    }

    fn active(&self, cell: [usize; 3], offset: [isize; 3]) -> u8 {
        let mut place = [0; 3];
        for axis in 0..3 {
            match cell[axis].checked_add_signed(offset[axis]) {
                Some(index) if index < self.size[axis] => place[axis] = index,
                _ => return 0,
            }
        }
        self.act[(place[2] * self.size[1] + place[1]) * self.size[0] + place[0]]
    }

    fn cells(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let [nx, ny, nz] = self.size;
        let row = move |y, z| (0..nx).map(move |x| [x, y, z]);
        (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| row(y, z)))
    }

    /// The rule alone.
    pub(crate) fn rule(&mut self) {
        let spread: Vec<u8> = self
            .cells()
            .map(|cell| NEIGHBOURS.iter().fold(0, |any, offset| any | self.active(cell, *offset)))
            .collect();
        for (cell, spread) in spread.into_iter().enumerate() {
            let (hum, act) = (self.hum[cell], self.act[cell]);
            self.hum[cell] = hum & (1 ^ act);
            self.cld[cell] |= act;
            self.act[cell] = (1 ^ act) & hum & spread;
        }
    }

    /// The rule and three draws around one ellipsoid.
    pub(crate) fn step(&mut self) {
        self.rule();
        let middle = self.size.map(|side| side as f32 / 2.0);
        for (index, cell) in self.cells().enumerate() {
            let away = |axis: usize| (cell[axis] as f32 - middle[axis]) / middle[axis];
            let distance = (away(0).powi(2) + away(1).powi(2) + away(2).powi(2)).sqrt();
            if self.cld[index] == 1 && self.draw() < 0.1 * (1.0 + distance) {
                self.cld[index] = 0;
            }
            if self.draw() < 0.1 * (1.0 - distance) {
                self.hum[index] = 1;
            }
            if self.draw() < 0.01 * (1.0 - distance) {
                self.act[index] = 1;
            }
        }
    }
}
