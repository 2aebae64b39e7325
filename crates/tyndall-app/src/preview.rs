//! How coarse the picture is while something moves, so that a frame stays within a sixtieth of a second or so.

/// Pixels of the view along one side of a preview pixel that may be chosen, the finest first.
const DIVISORS: [u32; 3] = [1, 2, 4];

/// Weight of the newest measurement.
const NEWEST_WEIGHT: f64 = 0.5;

/// Learns from measured frames which resolution is fast enough.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Preview {
    /// Time of a frame at each divisor and the pixels it had; none before it was tried.
    measured: [Option<Measured>; DIVISORS.len()],
    /// Whether the first frame has come, which includes the driver's compilation and says nothing about the others.
    warm: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Measured {
    ms: f64,
    pixels: f64,
}

impl Preview {
    /// Takes in a measured frame.
    pub(crate) fn learn(&mut self, divisor: u32, size_px: [u32; 2], ms: f64) {
        let Some(slot) = DIVISORS.iter().position(|known| *known == divisor) else { return };
        if !std::mem::replace(&mut self.warm, true) {
            return;
        }
        let old = self.measured[slot].map_or(ms, |old| old.ms);
        let pixels = f64::from(size_px[0]) * f64::from(size_px[1]);
        self.measured[slot] = Some(Measured { ms: old + (ms - old) * NEWEST_WEIGHT, pixels });
    }

    /// The finest divisor at which a view of this size takes no longer than `longest_ms`.
    pub(crate) fn divisor(&self, view_px: [u32; 2], longest_ms: f64) -> u32 {
        let fast = |(slot, divisor): &(usize, u32)| self.expected_ms(*slot, reduced(view_px, *divisor)) <= longest_ms;
        let chosen = DIVISORS.into_iter().enumerate().find(fast);
        chosen.map_or(DIVISORS[DIVISORS.len() - 1], |(_, divisor)| divisor)
    }

    /// Expected time of a frame: as measured at this divisor or else at the nearest one, in proportion to the pixels. An
    /// unmeasured machine is taken to be slow at full resolution, so that the first drag does not stutter.
    fn expected_ms(&self, slot: usize, size_px: [u32; 2]) -> f64 {
        let pixels = f64::from(size_px[0]) * f64::from(size_px[1]);
        let mut nearest: Vec<_> = (0..DIVISORS.len()).collect();
        nearest.sort_by_key(|other| other.abs_diff(slot));
        let known = nearest.into_iter().find_map(|slot| self.measured[slot]);
        match known {
            Some(Measured { ms, pixels: of }) => ms * pixels / of,
            None if slot == 0 => f64::INFINITY,
            None => 0.0,
        }
    }
}

/// Size of a picture whose pixels cover `divisor` pixels of the view in either direction.
pub(crate) fn reduced(view_px: [u32; 2], divisor: u32) -> [u32; 2] {
    view_px.map(|side| side.div_ceil(divisor).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW_PX: [u32; 2] = [1280, 720];

    #[test]
    fn a_fast_machine_previews_at_full_resolution_and_a_slow_one_does_not() {
        for (full_ms, divisor) in [(5.0, 1), (59.0, 1), (70.0, 2), (230.0, 2), (300.0, 4), (9000.0, 4)] {
            let mut preview = Preview::default();
            preview.learn(1, VIEW_PX, 1e6);
            preview.learn(1, VIEW_PX, full_ms);
            assert_eq!(preview.divisor(VIEW_PX, 60.0), divisor, "a frame takes {full_ms} ms");
        }
    }

    #[test]
    fn an_unmeasured_machine_starts_at_half_resolution() {
        assert_eq!(Preview::default().divisor(VIEW_PX, 60.0), 2, "nothing is known yet");
    }

    #[test]
    fn what_was_measured_counts_more_than_what_follows_from_another_resolution() {
        let mut preview = Preview { warm: true, ..Preview::default() };
        preview.learn(1, VIEW_PX, 100.0);
        // A frame has parts that do not shrink with the picture.
        preview.learn(2, reduced(VIEW_PX, 2), 80.0);
        assert_eq!(preview.divisor(VIEW_PX, 60.0), 4, "half resolution was too slow");
    }

    #[test]
    fn a_reduced_picture_covers_the_view_and_is_never_empty() {
        assert_eq!(reduced([1281, 720], 2), [641, 360], "rounded up");
        assert_eq!(reduced([1, 1], 4), [1, 1], "one pixel");
    }
}
