//! The declaration macros: [`params!`](crate::params!) and [`choice!`](crate::choice!).

/// Declares a closed set of alternatives. The string is the alternative's id; its number in files
/// is its place in the list, so the list only grows at its end.
#[macro_export]
macro_rules! choice {
    ($(#[$meta:meta])* $name:ident { $($(#[doc = $doc:literal])+ $item:ident = $id:literal),+ $(,)? }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $name { $($(#[doc = $doc])+ $item),+ }

        impl $name {
            /// The alternatives as the registry knows them.
            pub const ITEMS: &'static [$crate::params::ChoiceItem] = &[$($crate::params::ChoiceItem {
                id: $id,
                doc: concat!($($doc),+).trim_ascii(),
            }),+];
            const ALL: &'static [Self] = &[$(Self::$item),+];
        }

        impl $crate::params::ParamType for $name {
            fn unpack(value: &$crate::params::ParamValue) -> Option<Self> {
                let $crate::params::ParamValue::Choice(number) = value else { return None };
                Self::ALL.get(*number as usize).copied()
            }
        }
    };
}

/// Declares a typed parameter struct together with its public description:
///
/// ```text
/// params! {
///     /// Parameters of [`BLOCK`].
///     Params {
///         /// What it does: this text is the help that users see.
///         field "id in files": int [hard 0..=100 soft 0..=50 unit "px"] = 5;
///     }
/// }
/// ```
///
/// The id may be left out where it equals the field's name. Kinds are `int`, `float` (both with
/// ranges), `bool`, `choice [Enum]`, `text`, `path [read]` and `path [write]`.
#[macro_export]
macro_rules! params {
    (@id $field:ident) => { stringify!($field) };
    (@id $field:ident $id:literal) => { $id };
    (@range $hard:ident $hlo:literal ..= $hhi:literal $soft:ident $slo:literal ..= $shi:literal $(unit $unit:literal)?) => {
        ($crate::params::Range { min: $hlo, max: $hhi }, $crate::params::Range { min: $slo, max: $shi })
    };
    (@kind int $($range:tt)*) => {{
        let (hard, soft) = $crate::params!(@range $($range)*);
        $crate::params::ParamKind::Int { hard, soft }
    }};
    (@kind float $($range:tt)*) => {{
        let (hard, soft) = $crate::params!(@range $($range)*);
        $crate::params::ParamKind::Float { hard, soft }
    }};
    (@kind bool) => { $crate::params::ParamKind::Bool };
    (@kind choice $choice:ident) => { $crate::params::ParamKind::Choice($choice::ITEMS) };
    (@kind text) => { $crate::params::ParamKind::Text };
    (@kind path read) => { $crate::params::ParamKind::Path($crate::params::FileUse::Read) };
    (@kind path write) => { $crate::params::ParamKind::Path($crate::params::FileUse::Write) };
    (@unit $hard:ident $hlo:literal ..= $hhi:literal $soft:ident $slo:literal ..= $shi:literal unit $unit:literal) => { $unit };
    (@unit $($other:tt)*) => { "" };
    (@type int $($range:tt)*) => { i32 };
    (@type float $($range:tt)*) => { f64 };
    (@type bool) => { bool };
    (@type choice $choice:ident) => { $choice };
    (@type text) => { ::std::sync::Arc<str> };
    (@type path $use:ident) => { ::std::sync::Arc<str> };
    (@default int $default:expr) => { $crate::params::DefaultValue::Int($default) };
    (@default float $default:expr) => { $crate::params::DefaultValue::Float($default) };
    (@default bool $default:expr) => { $crate::params::DefaultValue::Bool($default) };
    (@default choice $default:expr) => { $crate::params::DefaultValue::Choice($default as u32) };
    (@default text $default:expr) => { $crate::params::DefaultValue::Text($default) };
    (@default path $default:expr) => { $crate::params::DefaultValue::Text($default) };
    ($(#[$meta:meta])* $name:ident {
        $($(#[doc = $doc:literal])+ $field:ident $($id:literal)?: $kind:ident $([$($range:tt)*])? = $default:expr;)*
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name { $($(#[doc = $doc])+ pub $field: $crate::params!(@type $kind $($($range)*)?),)* }

        impl $crate::params::ParamSet for $name {
            const SPECS: &'static [$crate::params::ParamSpec] = &[$($crate::params::ParamSpec {
                id: $crate::params!(@id $field $($id)?),
                doc: concat!($($doc, "\n"),+).trim_ascii(),
                kind: $crate::params!(@kind $kind $($($range)*)?),
                unit: $crate::params!(@unit $($($range)*)?),
                default: $crate::params!(@default $kind $default),
            }),*];

            #[allow(unused_variables, unused_mut, reason = "a block may have no parameters")]
            fn read(values: &[$crate::params::ParamValue]) -> Option<Self> {
                let mut values = values.iter();
                Some(Self { $($field: $crate::params::ParamType::unpack(values.next()?)?,)* })
            }
        }

        const _: () = $crate::params::check_specs(<$name as $crate::params::ParamSet>::SPECS);
    };
}
