//! The runner of shader functions finds what is wrong with them.

use tyndall_tests::{Tolerance, assert_matches_cpu, evaluate_text, mismatch, sample_box};

const PHASE: &str = include_str!("../fixtures/phase.wgsl");
const EXPRESSION: &str = "fixture_phase(x.x, x.y)";

/// Same name and arguments, in f64.
fn fixture_phase(cos_theta: f64, g: f64) -> f64 {
    let d = 1.0 + g * g - 2.0 * g * cos_theta;
    (1.0 - g * g) / (4.0 * std::f64::consts::PI * d * d.sqrt())
}

/// Measured on a software adapter: worst relative error 8.2e-6 for |g| <= 0.9, from the cancellation in d.
const TOLERANCE: Tolerance = Tolerance::relative(1e-5);

fn inputs() -> Vec<[f32; 4]> {
    sample_box(&[-1.0..=1.0, -0.9..=0.9, 0.0..=0.0, 0.0..=0.0], 4096)
}

#[test]
fn a_shader_function_matches_its_reference() {
    let values = evaluate_text(PHASE, EXPRESSION, &inputs()).unwrap_or_else(|error| panic!("{error}"));
    let report = mismatch(EXPRESSION, &inputs(), &values, |x| fixture_phase(x[0], x[1]), TOLERANCE);
    assert_eq!(report, None, "every value is within the tolerance");
}

#[test]
fn a_wrong_sign_in_the_shader_is_found() {
    let wrong = PHASE.replace("- 2.0 * g", "+ 2.0 * g");
    let values = evaluate_text(&wrong, EXPRESSION, &inputs()).unwrap_or_else(|error| panic!("{error}"));
    let report = mismatch(EXPRESSION, &inputs(), &values, |x| fixture_phase(x[0], x[1]), TOLERANCE);
    let report = report.expect("the twin has another sign");
    assert!(report.contains("of 4096 values outside") && report.contains("the reference"), "{report}");
}

#[test]
fn a_nan_in_one_of_many_values_is_found() {
    let inputs = inputs();
    let mut values: Vec<f32> = vec![1.0; inputs.len()];
    values[77] = f32::NAN;
    let report = mismatch("x", &inputs, &values, |_| 1.0, Tolerance::relative(0.5)).expect("one is not a number");
    assert!(report.contains("1 of 4096 values") && report.contains("NaN"), "{report}");
}

#[test]
fn an_expression_that_does_not_compile_names_its_place() {
    let error = evaluate_text(PHASE, "fixture_phase(x.x)", &inputs()).expect_err("an argument is missing").to_string();
    assert!(error.starts_with("test.wgsl:") && error.contains("fixture_phase"), "{error}");
}

#[test]
#[should_panic(expected = "is tried on 999 inputs, fewer than 1000")]
fn fewer_than_a_thousand_inputs_are_refused() {
    assert_matches_cpu("x.x", &[], &vec![[0.0; 4]; 999], |x| x[0], TOLERANCE);
}

#[test]
fn a_thousand_inputs_pass_where_shader_and_reference_agree() {
    let ranges = [-10.0..=10.0, 0.0..=5.0, 0.0..=0.0, 0.0..=0.0];
    assert_matches_cpu("x.x * x.y", &[], &sample_box(&ranges, 1000), |x| x[0] * x[1], Tolerance::relative(1e-6));
}
