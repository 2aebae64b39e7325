//! Fields of dunes kept between runs, beside the sky's tables: thousands of steps are slow to make.
//!
//! Kept are heights, bedrock, mean heights and the ledger as little-endian integers, so that a kept field is the one that was made, bit
//! for bit, and goes on as it would have. Fields with plants, on terrain from a file or touched by hand are not kept.

use tyndall_core::table_store::TableStore;
use tyndall_dunes::slab::DuneState;
use tyndall_dunes::{DesertInputs, DesertParams, DesertSimulation, DuneError, Ledger};

/// Version of the steps: another one makes other fields.
const VERSION: u32 = 2;

/// Words of the ledger: six amounts of two.
const LEDGER_WORDS: usize = 12;

/// The text that a field is kept under; `None` for those that are not kept.
pub(super) fn key(params: &DesertParams, inputs: &DesertInputs, steps: u32) -> Option<String> {
    let keeps = !params.plants.enabled && inputs.terrain.is_none() && inputs.touches.is_empty() && steps > 0;
    keeps.then(|| format!("field of dunes {VERSION}: {params:?}, {:?}, {steps} steps", inputs.winds))
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
    let words: Vec<i32> = bytes.as_chunks().0.iter().map(|word| i32::from_le_bytes(*word)).collect();
    if words.len() != 3 * cells + LEDGER_WORDS || bytes.len() != 4 * words.len() {
        return Ok(None);
    }
    let part = |index: usize| words[index * cells..(index + 1) * cells].to_vec();
    let (heights, bedrock, means) = (part(0), part(1), part(2));
    let ledger = ledger(&words[3 * cells..]);
    let state = DuneState { step: steps, heights, bedrock, means, plants: None, ledger };
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
    let words = state.heights.iter().chain(&state.bedrock).chain(&state.means);
    let Ledger { start, entered, left, brushed_on, brushed_off, abraded } = state.ledger;
    let amounts = [start, entered, left, brushed_on, brushed_off, abraded];
    let bytes = words.flat_map(|word| word.to_le_bytes()).chain(amounts.into_iter().flat_map(i64::to_le_bytes));
    store.store(key, &bytes.collect::<Vec<u8>>());
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;
    use std::sync::Mutex;

    use tyndall_dunes::Side;

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
        let (mut params, inputs, shelf) = (DesertParams::default(), DesertInputs::default(), Shelf::default());
        params.dunes.side = Side::Cells64;
        let mut made = DesertSimulation::cold(&params, &inputs).expect("default parameters");
        made.advance(30);
        let key = key(&params, &inputs, 30).expect("is kept");
        store(&shelf, &key, &made);
        let kept = load(&shelf, &key, (&params, &inputs, 30)).expect("default parameters");
        let mut kept = kept.expect("was kept");
        assert_eq!(kept.hash(), made.hash(), "as it was kept");
        made.advance(40);
        kept.advance(40);
        assert_eq!(kept.hash(), made.hash(), "40 steps later");
    }

    #[test]
    fn damaged_fields_are_forgotten_and_fields_with_plants_not_kept() {
        let (mut params, inputs, shelf) = (DesertParams::default(), DesertInputs::default(), Shelf::default());
        params.dunes.side = Side::Cells64;
        let key_of = key(&params, &inputs, 30).expect("is kept");
        shelf.store(&key_of, &[1, 2, 3]);
        assert!(load(&shelf, &key_of, (&params, &inputs, 30)).expect("no error").is_none(), "too short");
        assert_ne!(key(&params, &inputs, 31), Some(key_of), "another step");
        params.plants.enabled = true;
        assert_eq!(key(&params, &inputs, 30), None, "plants");
    }
}
