//! Passes of whole nests, called functions included.

use naga::{Block, Function, ShaderStage, Statement};

use super::annotation::count;
use crate::modules::{Module, assert_no_faults, faults_in};

/// Passes after which a software adapter ends all loops.
const LIMIT: u64 = 65_535;

/// Counts the passes of a module's functions.
struct Counter<'a> {
    module: &'a Module,
    faults: Vec<String>,
}

impl Counter<'_> {
    /// Passes of all loops of a function, those of the functions it calls included.
    fn function(&mut self, function: &Function) -> u64 {
        self.block(&function.body)
    }

    /// Loops one after the other add up, each with the pass that only finds its end. So do both sides of a branch: the
    /// invocations of a SIMD vector take both.
    fn block(&mut self, block: &Block) -> u64 {
        let mut passes = 0_u64;
        for (statement, span) in block.span_iter() {
            passes = passes.saturating_add(self.statement(statement, *span));
        }
        passes
    }

    fn statement(&mut self, statement: &Statement, span: naga::Span) -> u64 {
        match statement {
            Statement::Block(block) => self.block(block),
            Statement::If { accept, reject, .. } => self.block(accept).saturating_add(self.block(reject)),
            Statement::Switch { cases, .. } => {
                cases.iter().map(|case| self.block(&case.body)).fold(0, u64::saturating_add)
            }
            Statement::Call { function, .. } => {
                let module = self.module;
                self.function(&module.ir.functions[*function])
            }
            Statement::Loop { body, continuing, .. } => {
                let inner = self.block(body).saturating_add(self.block(continuing));
                self.count(span).saturating_mul(inner.saturating_add(1)).saturating_add(1)
            }
            _ => 0,
        }
    }

    /// Largest count of the loop at a place; a loop without one is a fault.
    fn count(&mut self, span: naga::Span) -> u64 {
        let line = span.location(&self.module.composed.source).line_number;
        count(self.module, line).unwrap_or_else(|error| {
            self.faults.push(format!("{}: {error}", self.module.place(span)));
            0
        })
    }
}

/// Loops without a count, in any function, and entry points with too many passes.
fn endless_loops(module: &Module) -> Vec<String> {
    let mut counter = Counter { module, faults: Vec::new() };
    for (_, function) in module.functions() {
        counter.function(function);
    }
    for entry in &module.ir.entry_points {
        let passes = counter.function(&entry.function);
        if passes > LIMIT {
            let stage = match entry.stage {
                ShaderStage::Vertex => "vertex",
                ShaderStage::Fragment => "fragment",
                _ => "compute",
            };
            let name = &entry.name;
            let file = &module.name;
            counter.faults.push(format!("{file}: {stage} `{name}` makes up to {passes} passes, more than {LIMIT}"));
        }
    }
    counter.faults.sort();
    counter.faults.dedup();
    counter.faults
}

#[test]
fn no_invocation_loops_more_often_than_a_software_adapter_allows() {
    assert_no_faults(
        endless_loops,
        "a software adapter ends all loops of an invocation after 65,535 passes in silence",
    );
}

/// Passes of the only entry point of a text.
fn passes(text: &str) -> u64 {
    let module = Module::of_text(text).unwrap_or_else(|error| panic!("{error}"));
    let mut counter = Counter { module: &module, faults: Vec::new() };
    let passes = counter.function(&module.ir.entry_points[0].function);
    assert!(counter.faults.is_empty(), "{:?}", counter.faults);
    passes
}

/// Nested loops with these counts around a statement, outermost first, as a compute shader.
fn nest(counts: &[u64]) -> String {
    let headers: Vec<_> =
        counts.iter().map(|n| format!("for (var i = 0u; i < {n}u; i++) {{ // loops: {n}\n")).collect();
    let open = headers.concat();
    format!("@compute @workgroup_size(1) fn main() {{\nvar x = 0u;\n{open}x += 1u;\n{}}}", "}\n".repeat(counts.len()))
}

#[test]
fn nests_cost_what_was_measured() {
    // A nest of N x M costs N (M + 2), three levels N (M (K + 2) + 2); the last test of the outermost loop is one more.
    assert_eq!(passes(&nest(&[40])), 40 + 1, "one loop");
    assert_eq!(passes(&nest(&[255, 256])), 255 * (256 + 2) + 1, "two levels");
    assert_eq!(passes(&nest(&[3, 5, 7])), 3 * (5 * (7 + 2) + 2) + 1, "three levels");
}

#[test]
fn nests_that_were_cut_are_found_and_one_that_ran_is_not() {
    for cut in [&[512, 128][..], &[255, 256], &[512, 127], &[65_536], &[40, 40, 40]] {
        let faults = faults_in(endless_loops, &nest(cut));
        assert!(faults.len() == 1 && faults[0].contains("`main` makes up to"), "{cut:?}: {faults:?}");
    }
    for fits in [&[512, 64][..], &[254, 255], &[40, 40, 30]] {
        assert_eq!(faults_in(endless_loops, &nest(fits)), Vec::<String>::new(), "{fits:?}");
    }
}

#[test]
fn loops_of_called_functions_and_of_both_sides_of_a_branch_count() {
    let text = "
        fn inner(n: u32) -> u32 {
            var x = 0u;
            for (var i = 0u; i < n; i++) { // loops: 100
                x += i;
            }
            return x;
        }
        @compute @workgroup_size(1) fn main(@builtin(global_invocation_id) id: vec3<u32>) {
            var x = 0u;
            if (id.x > 3u) { x = inner(3u); } else { x = inner(4u); }
            switch x {
                case 1u: { x += inner(5u); }
                default: {}
            }
            while (x < 9u) { // loops: 10
                x += inner(x);
            }
            loop { // loops: 20
                x += 1u;
                if (x > 7u) { break; }
            }
        }";
    assert_eq!(passes(text), 3 * 101 + (10 * (101 + 1) + 1) + 21, "branch, switch, nest by a call, and a plain loop");
}

#[test]
fn a_planted_loop_without_a_count_is_found_even_where_nobody_calls_it() {
    let text =
        "\nfn idle(n: u32) -> u32 {\n    var x = n;\n    while (x > 4u) {\n        x -= 1u;\n    }\n    return x;\n}";
    let faults = faults_in(endless_loops, text);
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert!(faults[0].starts_with("planted.wgsl:4: a loop without"), "{faults:?}");
}
