//! All loops of one shader invocation together stop silently after 65,535 passes on a software adapter, shared by the
//! invocations of a SIMD vector. Each loop therefore states its largest count in a comment on its first line,
//!
//! ```wgsl
//! for (var i = 0u; i < steps; i++) { // loops: MARCH_STEPS_MAX
//! ```
//!
//! which is a whole number, a `const`, an `override` (its largest value is the end of the range in the comment behind its
//! declaration, `// 1..=500`), or a parameter by its path (`sky.march_steps`, its largest value is the slider's end).

mod annotation;
mod cost;
