//! The declaring macros.

/// Declares a struct of parameters.
///
/// Each line reads `/// doc` and then `name: type = default, ["unit", low..=high, Scale], "source";`. Toggles and choices
/// leave the bracket out. Types are those of [`ParamType`](crate::params::ParamType). Texts follow in a section of their own,
/// `text { /// doc` and then `name = default, "source"; }`.
///
/// ```
/// use tyndall_core::{ParamSet, params};
///
/// params! {
///     /// A lamp.
///     pub struct Lamp {
///         /// Power that the lamp takes.
///         power_w: f64 = 40.0, ["W", 0.0..=2000.0, Log], "Catalogue, p. 3";
///         /// Whether it is on.
///         on: bool = true, "Catalogue, p. 4";
///     }
///     text {
///         /// Where it stands.
///         room = "kitchen", "Catalogue, p. 5";
///     }
/// }
///
/// let mut lamp = Lamp::default();
/// lamp.set_text("power_w", "60")?;
/// lamp.set_text("room", "hall")?;
/// assert_eq!(lamp, Lamp { power_w: 60.0, on: true, room: "hall".to_owned() });
/// assert_eq!(lamp.set("power_w", 9e9).unwrap_err().to_string(), "`power_w` = 9000000000 W is outside 0 to 2000 W");
/// # Ok::<(), tyndall_core::ParamError>(())
/// ```
#[macro_export]
macro_rules! params {
    ($(#[$meta:meta])* $visibility:vis struct $Set:ident { $(
        $(#[doc = $doc:literal])+
        $name:ident: $type:ty = $default:expr $(, [$unit:literal, $low:literal ..= $high:literal, $scale:ident])?, $source:literal;
    )+ } $(text { $(
        $(#[doc = $text_doc:literal])+
        $text:ident = $text_default:literal, $text_source:literal;
    )+ })?) => {
        $(#[$meta])*
        #[derive(Clone, Debug, PartialEq)]
        $visibility struct $Set { $(
            $(#[doc = $doc])+
            #[doc = concat!(
                "\n\nDefault: `", stringify!($default), "`." $(, " Unit: `", $unit, "`. Range: `", stringify!($low), "..=",
                stringify!($high), "`.")?, " Source: ", $source, "."
            )]
            $visibility $name: $type,
        )+ $($(
            $(#[doc = $text_doc])+
            #[doc = concat!("\n\nDefault: `\"", $text_default, "\"`. Source: ", $text_source, ".")]
            $visibility $text: String,
        )+)? }

        impl Default for $Set {
            fn default() -> Self {
                Self { $($name: $default,)+ $($($text: $text_default.to_owned(),)+)? }
            }
        }

        impl $crate::params::ParamSet for $Set {
            fn info(&self) -> &'static [$crate::params::ParamInfo] {
                static INFO: std::sync::LazyLock<Vec<$crate::params::ParamInfo>> =
                    std::sync::LazyLock::new(|| vec![$({
                        let declared = None $(.or(Some($crate::params::types::Limits {
                            unit: $unit, low: f64::from($low), high: f64::from($high), scale: $crate::params::Scale::$scale,
                        })))?;
                        let limits = $crate::params::types::limits::<$type>(declared);
                        $crate::params::ParamInfo {
                            name: stringify!($name),
                            unit: limits.unit,
                            kind: <$type as $crate::params::ParamType>::KIND,
                            range: limits.low..=limits.high,
                            default: <$type as $crate::params::ParamType>::to_value($default),
                            scale: limits.scale,
                            doc: concat!($($doc),+).trim(),
                            source: $source,
                        }
                    }),+]);
                &INFO
            }

            fn get(&self, index: usize) -> f64 {
                [$($crate::params::ParamType::to_value(self.$name)),+][index]
            }

            fn set_unchecked(&mut self, index: usize, value: f64) {
                // Compared by name, because a macro cannot count its repetitions.
                let name = self.info()[index].name;
                $(if name == stringify!($name) {
                    self.$name = $crate::params::ParamType::from_value(value);
                })+
            }

            fn text_info(&self) -> &'static [$crate::params::TextInfo] {
                static INFO: std::sync::LazyLock<Vec<$crate::params::TextInfo>> = std::sync::LazyLock::new(|| vec![$($(
                    $crate::params::TextInfo {
                        name: stringify!($text),
                        default: $text_default,
                        doc: concat!($($text_doc),+).trim(),
                        source: $text_source,
                    }
                ),+)?]);
                &INFO
            }

            fn text(&self, index: usize) -> &str {
                let texts: &[&str] = &[$($(&self.$text),+)?];
                texts[index]
            }

            fn put_text_unchecked(&mut self, index: usize, text: &str) {
                let texts: &mut [&mut String] = &mut [$($(&mut self.$text),+)?];
                text.clone_into(&mut *texts[index]);
            }
        }
    };
}

/// Declares an enum for parameters that pick one of a few names, in the order in which they are offered.
///
/// ```
/// tyndall_core::choices! {
///     /// Colour of a lamp.
///     pub enum Colour {
///         /// As a candle.
///         Warm = "warm",
///         /// As the sky.
///         Cold = "cold",
///     }
/// }
/// assert_eq!(Colour::NAMES, ["warm", "cold"]);
/// assert_eq!(Colour::Cold.name(), "cold");
/// ```
#[macro_export]
macro_rules! choices {
    ($(#[$meta:meta])* $visibility:vis enum $Choice:ident { $(
        $(#[doc = $doc:literal])+
        $variant:ident = $name:literal,
    )+ }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $visibility enum $Choice { $($(#[doc = $doc])+ $variant,)+ }

        impl $Choice {
            /// Names in scene files and on the command line.
            $visibility const NAMES: &'static [&'static str] = &[$($name),+];
            /// All variants, in the order of [`Self::NAMES`].
            $visibility const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// Name in scene files and on the command line.
            #[must_use]
            $visibility fn name(self) -> &'static str {
                match self { $(Self::$variant => $name),+ }
            }
        }

        impl $crate::params::ParamType for $Choice {
            const KIND: $crate::params::ParamKind = $crate::params::ParamKind::Choice(Self::NAMES);
            const FULL_RANGE: (f64, f64) = (0.0, (Self::NAMES.len() - 1) as f64);

            fn to_value(self) -> f64 {
                Self::ALL.iter().position(|choice| *choice == self).map_or(0.0, |index| index as f64)
            }

            fn from_value(value: f64) -> Self {
                Self::ALL.get($crate::params::types::choice_index(value)).copied().unwrap_or(Self::ALL[0])
            }
        }
    };
}
