//! Tests of `tyndall-gpu` on an adapter.

mod adapters;
mod bindings;
mod child;
mod loop_limit;
mod loss;
mod memory;
mod readback;
mod rendering;
mod sand;
mod shader_errors;
mod shader_functions;
mod timings;
