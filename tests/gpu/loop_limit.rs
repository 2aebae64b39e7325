//! The largest nests that the shaders' loop rule allows run in full, on the adapter at hand.

use tyndall_tests::evaluate_text;

/// Counts the passes of a nest; `x` is zero and hides the counts from the compiler, which would unroll them.
const NEST: &str = "
fn passes(n: u32, m: u32) -> f32 {
    var count = 0u;
    for (var i = 0u; i < n; i++) {
        for (var k = 0u; k < m; k++) {
            count += 1u + (i ^ k) / 65536u;
        }
    }
    return f32(count);
}";

#[test]
fn nests_that_the_loop_rule_allows_run_to_their_end() {
    let inputs = vec![[0.0; 4]; 1000];
    // n (m + 2) stays below 65,535.
    for (n, m) in [(1_u32, 65_533_u32), (254, 255), (512, 125), (16_383, 2)] {
        let expression = format!("passes({n}u + u32(x.x), {m}u + u32(x.y))");
        let values = evaluate_text(NEST, &expression, &inputs).unwrap_or_else(|error| panic!("{error}"));
        let short = values.iter().filter(|value| f64::from(**value) < f64::from(n * m)).count();
        assert_eq!(short, 0, "{n} x {m}: {short} of 1000 invocations were cut short, the first to {}", values[0]);
    }
}
