//! Errors of shaders name the original file, line and column.

use tyndall_gpu::{ComputePipeline, Gpu, GpuError, Shader};

fn noop() -> Gpu {
    Gpu::noop().expect("it needs no driver")
}

fn error_of(source: &str) -> String {
    Shader::from_source(&noop(), "sky/test.wgsl", source).expect_err("it is not valid").to_string()
}

#[test]
fn a_syntax_error_names_file_line_and_column_and_shows_the_line() {
    let error = error_of("fn fine() {}\nfn broken( {}\n");
    assert!(error.starts_with("sky/test.wgsl:2:12: "), "{error}");
    assert!(error.ends_with("\nfn broken( {}\n           ^"), "the caret stands below the column: {error}");
}

#[test]
fn a_type_error_names_file_and_line() {
    let error = error_of("\n\nfn mixed(x: f32) -> f32 {\n    return 1u + x;\n}\n");
    assert!(error.starts_with("sky/test.wgsl:4:"), "{error}");
}

#[test]
fn an_unknown_name_is_quoted() {
    let error = error_of("fn f() -> f32 { return phase_unknown(1.0); }\n");
    assert!(error.starts_with("sky/test.wgsl:1:24: ") && error.contains("phase_unknown"), "{error}");
}

#[test]
fn an_error_of_validation_says_what_and_why() {
    let error = error_of("@compute @workgroup_size(0)\nfn main() {}\n");
    assert!(error.starts_with("sky/test.wgsl:"), "{error}");
    assert!(error.to_lowercase().contains("workgroup"), "{error}");
}

#[test]
fn a_feature_that_not_every_adapter_has_is_refused() {
    let error = error_of("enable f16;\nfn half(x: f16) -> f16 { return x; }\n");
    assert!(error.starts_with("sky/test.wgsl:"), "{error}");
}

#[test]
fn a_missing_import_and_a_missing_file_are_errors() {
    let error = error_of("// @import common/nope.wgsl\n");
    assert!(error.starts_with("sky/test.wgsl:1: imports \"common/nope.wgsl\""), "{error}");
    let error = Shader::load(&noop(), "nope.wgsl").expect_err("no such file").to_string();
    assert!(error.contains("\"nope.wgsl\""), "{error}");
}

#[test]
fn an_unknown_entry_point_lists_those_there_are() {
    let gpu = noop();
    let source = "@compute @workgroup_size(1) fn first() {}\n@fragment fn second() {}\n";
    let shader = Shader::from_source(&gpu, "test.wgsl", source).expect("valid");
    let error = ComputePipeline::new(&gpu, &shader, "main", &[]).expect_err("no such entry").to_string();
    assert_eq!(error, "test.wgsl has no compute entry point `main`; it has: first", "of the same stage");
}

#[test]
fn an_unknown_or_impossible_constant_is_an_error_that_lists_the_constants() {
    let gpu = noop();
    let source = "override COUNT: u32 = 4u;\n@compute @workgroup_size(COUNT) fn main() {}\n";
    let shader = Shader::from_source(&gpu, "test.wgsl", source).expect("valid");
    for constant in [("COUNTS", 1.0), ("COUNT", f64::NAN), ("COUNT", -1.0)] {
        let error = ComputePipeline::new(&gpu, &shader, "main", &[constant]).expect_err("not possible");
        assert!(matches!(error, GpuError::Constants { .. }), "{constant:?}: {error}");
        assert!(error.to_string().ends_with("it has: COUNT"), "{error}");
    }
}
