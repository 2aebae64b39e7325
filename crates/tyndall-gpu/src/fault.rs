//! Faults planted from outside, so that the behaviour after a lost device can be tested.

use std::sync::atomic::{AtomicU64, Ordering};

/// Read-backs of this process so far, over all devices: after a loss and a rebuild the fault does not strike again.
static READBACKS: AtomicU64 = AtomicU64::new(0);

/// Destroys the device if this read-back is the one that `TYNDALL_FAULT=device-lost@N` names.
pub(crate) fn before_readback(device: &wgpu::Device) {
    let count = READBACKS.fetch_add(1, Ordering::Relaxed) + 1;
    let planted = std::env::var("TYNDALL_FAULT").ok().and_then(|faults| device_lost_at(&faults));
    if planted == Some(count) {
        tracing::warn!(count, "destroying the device because TYNDALL_FAULT says so");
        device.destroy();
    }
}

/// `N` of `device-lost@N` in a list separated by commas.
fn device_lost_at(faults: &str) -> Option<u64> {
    faults.split(',').find_map(|fault| fault.trim().strip_prefix("device-lost@")?.parse().ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fault_is_found_among_those_of_other_crates() {
        for (faults, at) in [
            ("device-lost@3", Some(3)),
            ("nan:density@7, device-lost@12", Some(12)),
            ("device-lost@", None),
            ("nan:density@7", None),
            ("", None),
        ] {
            assert_eq!(device_lost_at(faults), at, "TYNDALL_FAULT={faults}");
        }
    }
}
