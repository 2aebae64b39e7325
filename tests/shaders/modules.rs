//! All entry files, composed and validated without any optional capability.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};
use tyndall_gpu::{Gpu, Shader};
use tyndall_shaders::{Composed, FILES, compose, compose_snippet, entries};

/// A valid module and where its text came from.
#[derive(Debug)]
pub(crate) struct Module {
    pub(crate) name: String,
    pub(crate) composed: Composed,
    pub(crate) ir: naga::Module,
    pub(crate) info: ModuleInfo,
}

impl Module {
    /// A module from a text, for planted faults; it may import real files.
    pub(crate) fn of_text(text: &str) -> Result<Self, String> {
        let composed = compose_snippet("planted.wgsl", text).map_err(|error| error.to_string())?;
        Self::of_composed("planted.wgsl", composed)
    }

    fn of_composed(name: &str, composed: Composed) -> Result<Self, String> {
        let source = composed.source.as_str();
        let at = |location: Option<naga::SourceLocation>| {
            let location = location.map_or((1, 1), |l| (l.line_number, l.line_position));
            let (file, line) = composed.locate(location.0);
            format!("{file}:{line}:{}", location.1)
        };
        let ir = naga::front::wgsl::parse_str(source)
            .map_err(|error| format!("{}: {}", at(error.location(source)), error.message()))?;
        let info = Validator::new(ValidationFlags::all(), Capabilities::empty())
            .validate(&ir)
            .map_err(|error| format!("{}: {}", at(error.location(source)), error.as_inner()))?;
        Ok(Self { name: name.to_owned(), composed, ir, info })
    }

    /// Original `file:line` of a span.
    pub(crate) fn place(&self, span: naga::Span) -> String {
        let (file, line) = self.composed.locate(span.location(&self.composed.source).line_number);
        format!("{file}:{line}")
    }

    /// All functions with their names, entry points included.
    pub(crate) fn functions(&self) -> impl Iterator<Item = (&str, &naga::Function)> {
        let shared = self.ir.functions.iter().map(|(_, function)| (function.name.as_deref().unwrap_or(""), function));
        shared.chain(self.ir.entry_points.iter().map(|entry| (entry.name.as_str(), &entry.function)))
    }
}

/// Every entry file, or why it is not valid.
fn all() -> &'static [Result<Module, String>] {
    static ALL: OnceLock<Vec<Result<Module, String>>> = OnceLock::new();
    ALL.get_or_init(|| {
        let module = |name| Module::of_composed(name, compose(name).map_err(|error| error.to_string())?);
        entries().into_iter().map(module).collect()
    })
}

/// The valid ones; that all are is the test below.
pub(crate) fn valid() -> impl Iterator<Item = &'static Module> {
    all().iter().filter_map(|module| module.as_ref().ok())
}

/// Panics with the faults that a rule finds in any entry file, each once: shared files are a part of many.
pub(crate) fn assert_no_faults(rule: impl Fn(&Module) -> Vec<String>, reason: &str) {
    let faults: BTreeSet<String> = valid().flat_map(rule).collect();
    let list: Vec<String> = faults.into_iter().collect();
    assert!(list.is_empty(), "{reason}:\n{}", list.join("\n"));
}

/// The faults that a rule finds in a text.
pub(crate) fn faults_in(rule: impl Fn(&Module) -> Vec<String>, text: &str) -> Vec<String> {
    rule(&Module::of_text(text).unwrap_or_else(|error| panic!("the planted text itself is not valid: {error}")))
}

/// Files that no entry file imports.
fn dead_files<'a>(files: &[(&'a str, &str)], used: &BTreeSet<String>) -> Vec<&'a str> {
    files.iter().map(|(name, _)| *name).filter(|name| !used.contains(*name)).collect()
}

#[test]
fn every_entry_file_is_valid_without_optional_capabilities() {
    let gpu = Gpu::noop().expect("it needs no driver");
    let errors: Vec<String> =
        entries().into_iter().filter_map(|name| Some(Shader::load(&gpu, name).err()?.to_string())).collect();
    assert!(errors.is_empty(), "{}", errors.join("\n"));
    assert_eq!(valid().count(), entries().len(), "what the device takes, these tests take too");
}

#[test]
fn every_file_is_reached_from_an_entry_point() {
    let used = valid().flat_map(|module| module.composed.files.iter().map(ToString::to_string)).collect();
    let dead = dead_files(FILES, &used);
    assert!(dead.is_empty(), "no entry point reaches these files; remove them: {dead:?}");
}

#[test]
fn a_planted_dead_file_is_found() {
    let used = BTreeSet::from(["a.wgsl".to_owned()]);
    assert_eq!(dead_files(&[("a.wgsl", ""), ("b.wgsl", "")], &used), ["b.wgsl"], "nobody imports it");
}

#[test]
fn planted_errors_of_syntax_and_type_are_found_with_their_line() {
    for text in ["\nfn f( {}", "\nfn f() -> f32 { return 1u; }", "\nfn f() -> f32 { return g(); }"] {
        let error = Module::of_text(text).expect_err("not valid");
        assert!(error.starts_with("planted.wgsl:2:"), "{error}");
    }
}

#[test]
fn a_planted_optional_capability_is_refused() {
    for text in [
        "enable f16; fn f(x: f16) -> f16 { return x; }",
        "@group(0) @binding(0) var t: texture_storage_2d<r16unorm, write>; @compute @workgroup_size(1) fn f() \
         { textureStore(t, vec2<u32>(0u), vec4<f32>()); }",
    ] {
        assert!(Module::of_text(text).is_err(), "not every adapter has it: {text}");
    }
}
