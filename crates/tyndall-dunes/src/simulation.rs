//! What every automaton of this crate offers, in main memory and on a device.

use crate::lattice::Lattice;

/// An automaton that moves sand.
pub trait SandSimulation {
    /// Size of the bed.
    fn lattice(&self) -> Lattice;

    /// Steps since the start.
    fn steps_done(&self) -> u32;

    /// One step.
    fn step(&mut self);

    /// All sand (quanta), exactly.
    fn mass_quanta(&self) -> i64;

    /// A number that is equal for equal states and, but for 2^-64, for no others.
    fn state_hash(&self) -> u64;

    /// Several steps.
    fn run(&mut self, steps: u32) {
        for _ in 0..steps {
            self.step();
        }
    }
}

/// An automaton whose sand lies on a device, where work can fail and every look at the sand is a transfer. Its steps
/// give the bits of its host's.
pub trait SandDevice: Sized {
    /// The same automaton in main memory; whatever is asked of the sand is asked of it.
    type Host: SandSimulation;
    /// What can go wrong.
    type Error: std::error::Error;

    /// Size of the bed.
    fn lattice(&self) -> Lattice;

    /// Steps since the start, those under way included.
    fn steps_done(&self) -> u32;

    /// Starts several steps; they may still be under way when this returns.
    ///
    /// # Errors
    /// When the device refuses them or is lost.
    fn run(&mut self, steps: u32) -> Result<(), Self::Error>;

    /// Waits until all steps are done.
    ///
    /// # Errors
    /// When the device is lost.
    fn wait(&mut self) -> Result<(), Self::Error>;

    /// The automaton as it is after all steps, which are waited for.
    ///
    /// # Errors
    /// When the device is lost or its memory cannot be read.
    fn read(&self) -> Result<Self::Host, Self::Error>;

    /// Goes on from there, with its rule and winds.
    ///
    /// # Errors
    /// When the device cannot do what this automaton does, or refuses its size.
    fn write(&mut self, host: &Self::Host) -> Result<(), Self::Error>;
}

/// Makes the hash of a state: 64-bit FNV-1a over little-endian words of 32 bits, sizes and step first.
#[derive(Clone, Copy, Debug)]
pub struct StateHash(u64);

impl StateHash {
    /// For a bed of this size after so many steps.
    #[must_use]
    pub fn new(lattice: Lattice, step: u32) -> Self {
        let start = Self(0xCBF2_9CE4_8422_2325);
        lattice.size().into_iter().fold(start, |hash, side| hash.with_word(side as u64)).with_word(u64::from(step))
    }

    fn with_word(self, word: u64) -> Self {
        Self((self.0 ^ word).wrapping_mul(0x0100_0000_01B3))
    }

    /// The hash with a grid's values in index order.
    #[must_use]
    pub fn with_grid(self, grid: &[i32]) -> Self {
        grid.iter().fold(self, |hash, &value| hash.with_word(u64::from(value.cast_unsigned())))
    }

    /// The number.
    #[must_use]
    pub fn finish(self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }
}
