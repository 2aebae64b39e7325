//! A count of bytes in use, because drivers promise memory that does not exist.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::GpuError;

/// Left to the rest of the system where GPU memory is system memory.
const RESERVE_BYTES: u64 = 1 << 30;

/// The smallest default: enough for the program to start and to say what does not fit.
const MIN_DEFAULT_BYTES: u64 = 256 << 20;

/// The default on a system that does not report its memory.
const UNKNOWN_SYSTEM_BYTES: u64 = 2 << 30;

/// Bytes in use and allowed.
#[derive(Debug)]
pub(crate) struct Budget {
    used_bytes: AtomicU64,
    max_bytes: u64,
}

impl Budget {
    pub(crate) fn new(max_bytes: u64) -> Arc<Self> {
        Arc::new(Self { used_bytes: AtomicU64::new(0), max_bytes })
    }

    pub(crate) fn max_bytes(&self) -> u64 {
        self.max_bytes
    }

    pub(crate) fn used_bytes(&self) -> u64 {
        self.used_bytes.load(Ordering::Relaxed)
    }

    /// Takes `bytes` out of the budget until the share is dropped.
    pub(crate) fn reserve(self: &Arc<Self>, what: &str, bytes: u64) -> Result<Share, GpuError> {
        let take = |used: u64| used.checked_add(bytes).filter(|sum| *sum <= self.max_bytes);
        match self.used_bytes.fetch_update(Ordering::Relaxed, Ordering::Relaxed, take) {
            Ok(_) => Ok(Share { budget: Arc::clone(self), bytes }),
            Err(used) => Err(GpuError::OverBudget {
                what: what.to_owned(),
                needed_bytes: bytes,
                free_bytes: self.max_bytes.saturating_sub(used),
                budget_bytes: self.max_bytes,
            }),
        }
    }
}

/// A part of the budget; gives its bytes back when dropped.
#[derive(Debug)]
pub(crate) struct Share {
    budget: Arc<Budget>,
    bytes: u64,
}

impl Drop for Share {
    fn drop(&mut self) {
        self.budget.used_bytes.fetch_sub(self.bytes, Ordering::Relaxed);
    }
}

/// The budget when the user names none. wgpu does not tell how much memory a card has, so kinds with memory of their own
/// get what the smallest cards in use can give.
pub(crate) fn default_max_bytes(device_type: wgpu::DeviceType) -> u64 {
    match device_type {
        wgpu::DeviceType::DiscreteGpu => 3 << 30,
        wgpu::DeviceType::VirtualGpu | wgpu::DeviceType::Other => 2 << 30,
        wgpu::DeviceType::IntegratedGpu | wgpu::DeviceType::Cpu => {
            let available = available_system_bytes().unwrap_or(RESERVE_BYTES + UNKNOWN_SYSTEM_BYTES);
            available.saturating_sub(RESERVE_BYTES).max(MIN_DEFAULT_BYTES)
        }
    }
}

/// Memory that processes can still get, within the limit of a container if there is one; `None` where the system does
/// not tell.
fn available_system_bytes() -> Option<u64> {
    let mut system = sysinfo::System::new().ok()?;
    system.refresh_memory_specifics(sysinfo::MemoryRefreshKind::nothing().with_ram());
    let available = system.available_memory();
    let in_container = system.cgroup_limits().map(|limits| limits.free_memory);
    Some(in_container.map_or(available, |free| available.min(free))).filter(|bytes| *bytes > 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_are_refused_beyond_the_budget_and_return_when_dropped() {
        let budget = Budget::new(100);
        let first = budget.reserve("a", 60).expect("60 of 100");
        let error = budget.reserve("texture `b`", 41).expect_err("60 + 41 > 100").to_string();
        assert_eq!(
            error, "texture `b` needs 41 bytes, but of the memory budget of 100 bytes only 40 bytes are free",
            "all three numbers"
        );
        let second = budget.reserve("c", 40).expect("exactly full");
        drop(first);
        assert_eq!(budget.used_bytes(), 40, "the first share came back");
        drop(second);
        assert_eq!(budget.used_bytes(), 0, "all shares came back");
    }

    #[test]
    fn a_request_near_the_end_of_u64_does_not_wrap_around() {
        let budget = Budget::new(u64::MAX - 1);
        let _most = budget.reserve("a", u64::MAX - 2).expect("fits");
        assert!(budget.reserve("b", u64::MAX).is_err(), "the sum would wrap to a small number");
    }

    #[test]
    fn the_default_leaves_a_reserve_of_what_the_system_has() {
        let default = default_max_bytes(wgpu::DeviceType::Cpu);
        let available = available_system_bytes().unwrap_or(RESERVE_BYTES + UNKNOWN_SYSTEM_BYTES);
        let most = available.saturating_sub(RESERVE_BYTES / 2).max(MIN_DEFAULT_BYTES);
        assert!((MIN_DEFAULT_BYTES..=most).contains(&default), "{default} of {available}");
    }
}
