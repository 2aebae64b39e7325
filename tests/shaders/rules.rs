//! Constructs that some adapter computes wrongly without saying so, and leftovers.

use naga::{BinaryOperator, Expression, MathFunction, SampleLevel, ShaderStage, Statement};

use crate::modules::{Module, assert_no_faults, faults_in};

/// Faults among the expressions of all functions.
fn faults_of_expressions(
    module: &Module,
    fault: impl Fn(&naga::Function, &Expression, naga::Span) -> Option<String>,
) -> Vec<String> {
    let mut faults = Vec::new();
    for (name, function) in module.functions() {
        for (handle, expression) in function.expressions.iter() {
            let span = function.expressions.get_span(handle);
            if let Some(text) = fault(function, expression, span) {
                faults.push(format!("{}: {text} in `{name}`", module.place(span)));
            }
        }
    }
    faults
}

fn implicit_levels(module: &Module) -> Vec<String> {
    faults_of_expressions(module, |_, expression, _| match expression {
        Expression::ImageSample { level: SampleLevel::Exact(_) | SampleLevel::Zero, .. } => None,
        Expression::ImageSample { .. } => Some("a texture sample whose level depends on neighbours".to_owned()),
        _ => None,
    })
}

#[test]
fn textures_are_sampled_at_a_given_level() {
    assert_no_faults(implicit_levels, "browsers refuse implicit levels in non-uniform flow; use textureSampleLevel");
}

#[test]
fn planted_samples_without_a_level_are_found() {
    let text = |call: &str| {
        format!(
            "@group(0) @binding(0) var t: texture_2d<f32>;\n@group(0) @binding(1) var s: sampler;
             @fragment fn fs(@location(0) uv: vec2<f32>) -> @location(0) vec4<f32> {{\n return {call};\n}}"
        )
    };
    for call in ["textureSample(t, s, uv)", "textureSampleBias(t, s, uv, 1.0)", "textureSampleGrad(t, s, uv, uv, uv)"] {
        let faults = faults_in(implicit_levels, &text(call));
        assert!(faults.len() == 1 && faults[0].starts_with("planted.wgsl:4: "), "{call}: {faults:?}");
    }
    for call in ["textureSampleLevel(t, s, uv, 0.0)", "textureLoad(t, vec2<u32>(uv), 0)"] {
        assert_eq!(faults_in(implicit_levels, &text(call)), Vec::<String>::new(), "{call} is right");
    }
}

fn inaccurate_angles(module: &Module) -> Vec<String> {
    faults_of_expressions(module, |_, expression, _| {
        matches!(expression, Expression::Math { fun: MathFunction::Acos, .. }).then(|| "acos".to_owned())
    })
}

#[test]
fn angles_are_compared_without_acos() {
    assert_no_faults(inaccurate_angles, "acos is off by 1.6e-4 rad on a software adapter; compare cosines or chords");
}

#[test]
fn a_planted_acos_is_found() {
    let faults = faults_in(inaccurate_angles, "\nfn angle(c: f32) -> f32 { return acos(c); }");
    assert_eq!(faults, ["planted.wgsl:2: acos in `angle`"], "with line and function");
}

fn comparisons_with_itself(module: &Module) -> Vec<String> {
    faults_of_expressions(module, |_, expression, span| {
        let Expression::Binary { op, left, right } = expression else { return None };
        let sign = match op {
            BinaryOperator::Equal => "==",
            BinaryOperator::NotEqual => "!=",
            _ => return None,
        };
        let text = span.to_range().and_then(|range| module.composed.source.get(range)).unwrap_or_default();
        let is_same_text = text.split_once(sign).is_some_and(|(a, b)| a.trim() == b.trim());
        (left == right || is_same_text).then(|| format!("`{text}`"))
    })
}

#[test]
fn nothing_is_compared_with_itself() {
    assert_no_faults(comparisons_with_itself, "x != x is false for NaN on a software adapter; test the exponent bits");
}

#[test]
fn planted_comparisons_with_itself_are_found_and_others_are_not() {
    for body in ["return x != x;", "return x == x;", "let y = x; return x != y;", "var v = x; v += 1.0; return v != v;"]
    {
        let faults = faults_in(comparisons_with_itself, &format!("fn f(x: f32) -> bool {{ {body} }}"));
        assert_eq!(faults.len(), 1, "{body}: {faults:?}");
    }
    let faults = faults_in(comparisons_with_itself, "fn f(x: vec2<f32>) -> bool { return any(x.xy != x.xy); }");
    assert_eq!(faults.len(), 1, "of vectors: {faults:?}");
    let changed = "fn f(x: f32) -> bool { var v = x; let before = v; v += 1.0; return v != before; }";
    assert_eq!(faults_in(comparisons_with_itself, changed), Vec::<String>::new(), "an old value against the new");
}

fn unused_bindings(module: &Module) -> Vec<String> {
    let entries = 0..module.ir.entry_points.len();
    let is_unused = |handle: naga::Handle<naga::GlobalVariable>| {
        entries.clone().all(|entry| module.info.get_entry_point(entry)[handle].is_empty())
    };
    let bound = module.ir.global_variables.iter().filter(|(_, variable)| variable.binding.is_some());
    bound
        .filter(|(handle, _)| is_unused(*handle))
        .map(|(handle, variable)| {
            let place = module.place(module.ir.global_variables.get_span(handle));
            format!("{place}: `{}`", variable.name.as_deref().unwrap_or(""))
        })
        .collect()
}

#[test]
fn every_binding_is_used_by_an_entry_point() {
    assert_no_faults(unused_bindings, "these variables are bound but no entry point of their file uses them");
}

#[test]
fn a_planted_unused_binding_is_found() {
    let text = "@group(0) @binding(0) var<storage, read_write> out: array<f32>;
        @group(0) @binding(1) var<uniform> gain: f32;
        fn helper() -> f32 { return gain; }
        @compute @workgroup_size(1) fn main() { out[0] = 1.0; }";
    assert_eq!(faults_in(unused_bindings, text), ["planted.wgsl:2: `gain`"], "used by a function nobody calls");
}

/// Entry points of compute shaders whose first statement is no `if (..) { return; }`.
fn missing_guards(module: &Module) -> Vec<String> {
    let compute = module.ir.entry_points.iter().filter(|entry| entry.stage == ShaderStage::Compute);
    compute
        .filter(|entry| !entry.function.body.iter().find(|s| !matches!(s, Statement::Emit(_))).is_some_and(is_guard))
        .map(|entry| format!("{}: `{}`", module.name, entry.name))
        .collect()
}

fn is_guard(statement: &Statement) -> bool {
    match statement {
        Statement::If { accept, reject, .. } => {
            reject.is_empty() && matches!(accept.last(), Some(Statement::Return { value: None }))
        }
        _ => false,
    }
}

#[test]
fn every_compute_entry_starts_with_a_bounds_guard() {
    assert_no_faults(
        missing_guards,
        "dispatches are rounded up: the first statement must be `if (outside) { return; }`",
    );
}

#[test]
fn a_planted_entry_without_a_guard_is_found() {
    let text = |body: &str| {
        format!(
            "@group(0) @binding(0) var<storage, read_write> out: array<f32>;
             @compute @workgroup_size(8) fn main(@builtin(global_invocation_id) id: vec3<u32>) {{ {body} }}"
        )
    };
    for body in [
        "out[id.x] = 1.0;",
        "out[id.x] = 1.0; if (id.x >= 8u) { return; }",
        "if (id.x < 8u) { out[id.x] = 1.0; }",
        "if (id.x >= 8u) { return; } else { out[0] = 1.0; }",
    ] {
        assert_eq!(faults_in(missing_guards, &text(body)), ["planted.wgsl: `main`"], "{body}");
    }
    for body in [
        "if (id.x >= arrayLength(&out)) { return; } out[id.x] = 1.0;",
        "let size = arrayLength(&out); if (id.x >= size) { return; } out[id.x] = 1.0;",
    ] {
        assert_eq!(faults_in(missing_guards, &text(body)), Vec::<String>::new(), "{body}");
    }
}
