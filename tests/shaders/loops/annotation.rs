//! The largest count of a loop from the comment on its first line.

use naga::{Expression, Literal};
use tyndall_scene::Scene;

use crate::modules::Module;

/// What stands before the count.
const MARK: &str = "// loops: ";

/// Largest number of passes of the loop that begins on a line of the composed text (from 1).
pub(crate) fn count(module: &Module, line: u32) -> Result<u64, String> {
    let text = module.composed.source.lines().nth(line as usize - 1).unwrap_or_default();
    let (code, name) =
        text.split_once(MARK).ok_or_else(|| format!("a loop without `{MARK}COUNT` on its first line"))?;
    let name = name.trim();
    let count = resolve(module, name).ok_or_else(|| {
        format!("`{name}` is no number, constant, override with a range in its comment, or parameter")
    })?;
    match bound(module, code) {
        Some(bound) if bound > count => Err(format!("the loop runs to {bound}, but its comment says {count}")),
        _ => Ok(count),
    }
}

fn resolve(module: &Module, name: &str) -> Option<u64> {
    let digits = name.strip_suffix('u').unwrap_or(name);
    digits
        .parse()
        .ok()
        .or_else(|| constant(module, name))
        .or_else(|| override_maximum(&module.composed.source, name))
        .or_else(|| parameter_maximum(name))
}

/// Value of a `const` whole number. Constants without a type are written into their users and leave the module, so for
/// them the declaration is read.
fn constant(module: &Module, name: &str) -> Option<u64> {
    let typed = module.ir.constants.iter().find(|(_, constant)| constant.name.as_deref() == Some(name));
    match typed.map(|(_, constant)| &module.ir.global_expressions[constant.init]) {
        Some(Expression::Literal(Literal::U32(value))) => Some((*value).into()),
        Some(Expression::Literal(Literal::I32(value))) => (*value).try_into().ok(),
        Some(_) => None,
        None => {
            let value = declaration(&module.composed.source, "const ", name)?.split_once('=')?.1;
            value.split(';').next()?.trim().parse().ok()
        }
    }
}

/// The line that declares a name, from behind the name.
fn declaration<'a>(source: &'a str, keyword: &str, name: &str) -> Option<&'a str> {
    source.lines().find_map(|line| {
        let rest = line.trim_start().strip_prefix(keyword)?.strip_prefix(name)?;
        rest.starts_with([':', ' ', '=']).then_some(rest)
    })
}

/// End of the range in the comment behind `override NAME`.
fn override_maximum(source: &str, name: &str) -> Option<u64> {
    let range = declaration(source, "override ", name)?.split_once("//")?.1;
    range.split_once("..=")?.1.split_whitespace().next()?.trim_end_matches(['.', ',', ';']).parse().ok()
}

/// End of the range of a parameter by its path.
fn parameter_maximum(path: &str) -> Option<u64> {
    let (group, name) = path.split_once('.')?;
    let scene = Scene::default();
    let (_, parameters) = scene.groups().into_iter().find(|(known, _)| *known == group)?;
    let info = parameters.info().iter().find(|info| info.name == name)?;
    let end = *info.range.end();
    #[expect(clippy::cast_possible_truncation, reason = "checked to be a whole number below 2^32")]
    let count = end as u64;
    (end.fract() == 0.0 && (0.0..=4_294_967_295.0).contains(&end)).then_some(count)
}

/// The number that a `for` header of the form `..; i < NUMBER; ..` compares with, if it can be known.
fn bound(module: &Module, code: &str) -> Option<u64> {
    let condition = code.split(';').nth(1)?;
    let (_, limit) = condition.split_once('<')?;
    let (limit, extra) = limit.strip_prefix('=').map_or((limit, 0), |limit| (limit, 1));
    Some(resolve(module, limit.trim())? + extra)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count_in(text: &str, line: u32) -> Result<u64, String> {
        count(&Module::of_text(text).unwrap_or_else(|error| panic!("{error}")), line)
    }

    fn count_of(before: &str, header: &str, mark: &str) -> Result<u64, String> {
        count_in(&format!("{before}\nfn f(n: u32) {{\n{header} {{ {mark}\n}} }}"), 3)
    }

    #[test]
    fn numbers_constants_overrides_and_parameters_are_resolved() {
        let header = "for (var i = 0u; i < n; i++)";
        for (before, name, want) in [
            ("", "8", 8),
            ("", "8u", 8),
            ("const STEPS: u32 = 40u;", "STEPS", 40),
            ("const STEPS = 41;", "STEPS", 41),
            ("override STEPS: u32 = 40u; // 1..=500", "STEPS", 500),
            ("override STEPS = 40; // samples, 1..=501.", "STEPS", 501),
            ("", "sky.march_steps", 64),
        ] {
            assert_eq!(count_of(before, header, &format!("// loops: {name}")), Ok(want), "{before} {name}");
        }
    }

    #[test]
    fn loops_without_a_count_that_can_be_resolved_are_errors() {
        for header in ["for (var i = 0u; i < n; i++)", "while (n > 4u)"] {
            let error = count_of("", header, "").expect_err("no comment");
            assert!(error.starts_with("a loop without"), "{error}");
            let texts = ["override STEPS: u32 = 40u;", "const STEPS = 4.5;", ""];
            for before in texts {
                let error = count_of(before, header, "// loops: STEPS").expect_err("no whole number");
                assert!(error.starts_with("`STEPS` is no number"), "{before}: {error}");
            }
            assert!(count_of("", header, "// loops: sky.unknown").is_err(), "no such parameter");
            assert!(count_of("", header, "// loops: camera.x_m -").is_err(), "nothing but the name");
        }
    }

    #[test]
    fn a_count_below_the_header_of_its_loop_is_an_error() {
        let steps = "const STEPS: u32 = 40u;";
        for (header, name) in [
            ("for (var i = 0u; i < 9u; i++)", "8"),
            ("for (var i = 0u; i <= 8u; i++)", "8"),
            ("for (var i = 0u; i < STEPS; i++)", "39"),
        ] {
            let error = count_of(steps, header, &format!("// loops: {name}")).expect_err("it runs longer");
            assert!(error.contains("its comment says"), "{header}: {error}");
        }
        assert_eq!(count_of(steps, "for (var i = 0u; i <= 8u; i++)", "// loops: 9"), Ok(9), "0 to 8");
    }
}
