//! Fields of dunes kept between runs, beside the sky's tables: thousands of steps are slow to make.
//!
//! Kept are heights, bedrock, mean heights, the ledger and plants as little-endian integers, so that a kept field is the one
//! that was made, bit for bit, and goes on as it would have. Fields that were touched by hand or began with a state from a
//! file are not kept.

use tyndall_core::table_store::TableStore;
use tyndall_dunes::slab::{DuneState, PlantState};
use tyndall_dunes::terrain::Terrain;
use tyndall_dunes::{DesertInputs, DesertParams, DesertSimulation, DuneError, Ledger};

/// Version of the steps: another one makes other fields.
const VERSION: u32 = 3;

/// Words of the ledger: six amounts of two.
const LEDGER_WORDS: usize = 12;

/// The text that a field is kept under; `None` for those that are not kept.
pub(super) fn key(params: &DesertParams, inputs: &DesertInputs, steps: u32) -> Option<String> {
    let terrain = inputs.terrain.as_deref().map(fingerprint);
    let text =
        || format!("field of dunes {VERSION}: {params:?}, {:?}, terrain {terrain:?}, {steps} steps", inputs.winds);
    (inputs.touches.is_empty() && steps > 0).then(text)
}

/// Size of a terrain and the 64-bit FNV-1a hash of its heights' bits.
fn fingerprint(terrain: &Terrain) -> ([usize; 2], u64) {
    let bytes = terrain.height_m.iter().flat_map(|height| height.to_bits().to_le_bytes());
    let hash = bytes
        .fold(0xCBF2_9CE4_8422_2325, |hash: u64, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3));
    (terrain.size, hash)
}

/// The kept field, if there is one.
pub(super) fn load(
    store: &dyn TableStore,
    key: &str,
    (params, inputs, steps): (&DesertParams, &DesertInputs, u32),
) -> Result<Option<DesertSimulation>, DuneError> {
    let Some(bytes) = store.load(key) else { return Ok(None) };
    let mut simulation = DesertSimulation::cold(params, inputs)?;
    let cells = simulation.field().heights().len();
    // Cells are counted in fours, so that covers of plants, a byte each, end with a word.
    let grids = if params.plants.enabled { 4 } else { 3 };
    let [of_grids, of_ledger] = [4 * grids * cells, 4 * LEDGER_WORDS];
    let of_covers = if params.plants.enabled { cells } else { 0 };
    if bytes.len() != of_grids + of_ledger + of_covers {
        return Ok(None);
    }
    let words = |bytes: &[u8]| bytes.as_chunks().0.iter().map(|word| i32::from_le_bytes(*word)).collect::<Vec<i32>>();
    let part = |index: usize| words(&bytes[4 * index * cells..4 * (index + 1) * cells]);
    let cover = &bytes[of_grids + of_ledger..];
    let plants = params.plants.enabled.then(|| PlantState { cover: cover.to_vec(), heights_then: part(3) });
    let (heights, bedrock, means) = (part(0), part(1), part(2));
    let ledger = ledger(&words(&bytes[of_grids..of_grids + of_ledger]));
    let state = DuneState { step: steps, heights, bedrock, means, plants, ledger };
    Ok(simulation.field_mut().set_state(state).is_ok().then_some(simulation))
}

/// Amounts from their low and high words.
fn ledger(words: &[i32]) -> Ledger {
    let amount = |index: usize| i64::from(words[2 * index].cast_unsigned()) | (i64::from(words[2 * index + 1]) << 32);
    let [start, entered, left, brushed_on, brushed_off, abraded] = [0, 1, 2, 3, 4, 5].map(amount);
    Ledger { start, entered, left, brushed_on, brushed_off, abraded }
}

/// Keeps a field.
pub(super) fn store(store: &dyn TableStore, key: &str, simulation: &DesertSimulation) {
    let state = simulation.field().state();
    let (heights_then, cover) =
        state.plants.map_or_else(Default::default, |plants| (plants.heights_then, plants.cover));
    let words = state.heights.iter().chain(&state.bedrock).chain(&state.means).chain(&heights_then);
    let Ledger { start, entered, left, brushed_on, brushed_off, abraded } = state.ledger;
    let amounts = [start, entered, left, brushed_on, brushed_off, abraded];
    let bytes = words.flat_map(|word| word.to_le_bytes()).chain(amounts.into_iter().flat_map(i64::to_le_bytes));
    let bytes = bytes.chain(cover);
    store.store(key, &bytes.collect::<Vec<u8>>());
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;
    use std::sync::Mutex;

    use std::sync::Arc;

    use tyndall_dunes::{Side, by_hand};

    use super::*;

    #[derive(Debug, Default)]
    struct Shelf(Mutex<HashMap<String, Vec<u8>>>);

    impl TableStore for Shelf {
        fn load(&self, key: &str) -> Option<Vec<u8>> {
            self.0.lock().ok()?.get(key).cloned()
        }

        fn store(&self, key: &str, bytes: &[u8]) {
            if let Ok(mut shelf) = self.0.lock() {
                shelf.insert(key.to_owned(), bytes.to_vec());
            }
        }
    }

    #[test]
    fn a_kept_field_is_the_one_that_was_made_and_goes_on_alike() {
        for (has_plants, terrain) in [(false, None), (true, None), (true, Some(Arc::new(hill())))] {
            let mut params = DesertParams::default();
            (params.dunes.side, params.plants.enabled) = (Side::Cells64, has_plants);
            goes_on_alike(&params, &DesertInputs { terrain, ..DesertInputs::default() });
        }
    }

    fn hill() -> Terrain {
        Terrain { size: [2, 2], height_m: vec![0.0, 3.0, 1.0, 2.0] }
    }

    fn goes_on_alike(params: &DesertParams, inputs: &DesertInputs) {
        let shelf = Shelf::default();
        let mut made = DesertSimulation::cold(params, inputs).expect("default parameters");
        made.advance(30);
        let key = key(params, inputs, 30).expect("is kept");
        store(&shelf, &key, &made);
        let kept = load(&shelf, &key, (params, inputs, 30)).expect("default parameters");
        let mut kept = kept.expect("was kept");
        assert_eq!(kept.state(), made.state(), "as it was kept");
        made.advance(40);
        kept.advance(40);
        assert_eq!(kept.state(), made.state(), "40 steps later");
    }

    #[test]
    fn damaged_fields_are_forgotten_and_those_touched_by_hand_not_kept() {
        let (mut params, inputs, shelf) = (DesertParams::default(), DesertInputs::default(), Shelf::default());
        params.dunes.side = Side::Cells64;
        let key_of = key(&params, &inputs, 30).expect("is kept");
        shelf.store(&key_of, &[1, 2, 3]);
        assert!(load(&shelf, &key_of, (&params, &inputs, 30)).expect("no error").is_none(), "too short");
        assert_ne!(key(&params, &inputs, 31), Some(key_of), "another step");
        let on = |terrain: Terrain| DesertInputs { terrain: Some(Arc::new(terrain)), ..DesertInputs::default() };
        let (mut other, same) = (hill(), key(&params, &on(hill()), 30));
        other.height_m[3] += 1e-3;
        assert_ne!(key(&params, &on(other), 30), same, "another terrain");
        let strokes = by_hand::parse_strokes("20 dig 6 2 0 0").expect("a stroke");
        let touches = by_hand::touches(&strokes, 1.0, [64, 64]).expect("a stroke");
        assert_eq!(key(&params, &DesertInputs { touches, ..inputs }, 30), None, "by hand");
    }
}
