//! Parameters: the words of the library's own blocks, as tables of the contract.

use std::ffi::{CStr, c_char};

use ptlib_plugin_abi::*;

use crate::private::count;

/// A parameter struct that [`params!`](crate::params!) declared.
pub trait ParamSet: Sized {
    /// The declared parameters, in order.
    const TABLE: &'static [&'static ptlp_param];

    /// The struct with the values that the host gives.
    #[must_use]
    fn read(values: &[&ptlp_value]) -> Self;
}

impl ParamSet for () {
    const TABLE: &'static [&'static ptlp_param] = &[];

    fn read(_: &[&ptlp_value]) -> Self {}
}

/// A Rust type that a parameter's field can have.
pub trait ParamType {
    /// The field's value.
    fn unpack(value: &ptlp_value) -> Self;
}

impl ParamType for i32 {
    fn unpack(value: &ptlp_value) -> Self {
        // The host keeps it in the declared range, which has 32 bits.
        Self::try_from(value.integer).unwrap_or_default()
    }
}

impl ParamType for f64 {
    fn unpack(value: &ptlp_value) -> Self {
        value.number
    }
}

impl ParamType for bool {
    fn unpack(value: &ptlp_value) -> Self {
        value.integer != 0
    }
}

impl ParamType for String {
    fn unpack(value: &ptlp_value) -> Self {
        if value.text.is_null() {
            return Self::new();
        }
        // SAFETY: the contract: the text ends with NUL.
        unsafe { CStr::from_ptr(value.text) }.to_string_lossy().into_owned()
    }
}

/// Value number `place`.
///
/// # Panics
/// If the host gives fewer values than were declared, which it does not.
#[must_use]
pub fn value_of<T: ParamType>(values: &[&ptlp_value], place: usize) -> T {
    T::unpack(values.get(place).expect("the host gives every value"))
}

/// A parameter of numbers, to which [`params!`](crate::params!) adds the rest.
#[must_use]
pub const fn number(r#type: u32, id: *const c_char, doc: *const c_char) -> ptlp_param {
    ptlp_param {
        struct_size: count(size_of::<ptlp_param>()),
        r#type,
        flags: 0,
        choice_count: 0,
        min: 0.0,
        max: 0.0,
        soft_min: 0.0,
        soft_max: 0.0,
        default_value: 0.0,
        id,
        doc,
        unit: std::ptr::null(),
        default_text: std::ptr::null(),
        choice_ids: std::ptr::null(),
        choice_docs: std::ptr::null(),
    }
}

/// Declares a closed set of alternatives. The string is the alternative's id; its number in files
/// is its place in the list, so the list only grows at its end.
///
/// ```
/// # use ptlib_plugin::prelude::*;
/// choice! {
///     /// How things are joined.
///     Join {
///         /// At their corners.
///         Corners = "corners",
///         /// Along their edges.
///         Edges = "edges",
///     }
/// }
/// # fn main() {
/// assert_eq!(Join::default(), Join::Corners);
/// # }
/// ```
#[macro_export]
macro_rules! choice {
    ($(#[$meta:meta])* $name:ident {
        $($(#[doc = $doc:literal])+ $item:ident = $id:literal),+ $(,)?
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum $name { $($(#[doc = $doc])+ $item),+ }

        impl $name {
            const ALL: &'static [Self] = &[$(Self::$item),+];
            #[doc(hidden)]
            pub const IDS: &'static [*const ::std::ffi::c_char] =
                &[$(concat!($id, "\0").as_ptr().cast()),+];
            #[doc(hidden)]
            pub const DOCS: &'static [*const ::std::ffi::c_char] =
                &[$(concat!($($doc),+, "\0").as_ptr().cast()),+];
        }

        impl Default for $name {
            fn default() -> Self {
                Self::ALL[0]
            }
        }

        impl $crate::ParamType for $name {
            fn unpack(value: &$crate::private::abi::ptlp_value) -> Self {
                let place = usize::try_from(value.integer).unwrap_or_default();
                Self::ALL.get(place).copied().unwrap_or_default()
            }
        }
    };
}

/// Declares a typed parameter struct together with its public description, in the words of the
/// library's own blocks:
///
/// ```text
/// params! {
///     /// Parameters of the block.
///     Params {
///         /// What it does: this text is the help that users see.
///         field "id in files": int [hard 0..=100 soft 0..=50 unit "px"] = 5;
///     }
/// }
/// ```
///
/// The id may be left out where it equals the field's name. Kinds are `int` (`i32`), `float`
/// (`f64`), both with ranges, `bool`, `choice [Enum]`, `text`, `path [read]` and `path [write]`
/// (`String`).
#[macro_export]
macro_rules! params {
    (@id $field:ident) => { concat!(stringify!($field), "\0") };
    (@id $field:ident $id:literal) => { concat!($id, "\0") };
    (@type int $($range:tt)*) => { i32 };
    (@type float $($range:tt)*) => { f64 };
    (@type bool) => { bool };
    (@type choice $choice:ident) => { $choice };
    (@type text) => { String };
    (@type path $use:ident) => { String };
    ($(#[$meta:meta])* $name:ident {
        $($(#[doc = $doc:literal])+ $field:ident $($id:literal)?: $kind:ident $([$($range:tt)*])? = $default:expr;)*
    }) => {
        $(#[$meta])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $name { $($(#[doc = $doc])+ pub $field: $crate::params!(@type $kind $($($range)*)?),)* }

        impl $crate::ParamSet for $name {
            const TABLE: &'static [&'static $crate::private::abi::ptlp_param] = &[$({
                const PARAM: $crate::private::abi::ptlp_param = {
                    let mut param = $crate::private::number(
                        0,
                        $crate::params!(@id $field $($id)?).as_ptr().cast(),
                        concat!($($doc, "\n"),+, "\0").as_ptr().cast(),
                    );
                    $crate::param_kind!(param $kind $default; $($($range)*)?);
                    param
                };
                &PARAM
            }),*];

            #[allow(unused_assignments, unused_mut, reason = "a block may have no parameters")]
            fn read(values: &[&$crate::private::abi::ptlp_value]) -> Self {
                let mut place = 0;
                Self { $($field: {
                    place += 1;
                    $crate::private::value_of(values, place - 1)
                },)* }
            }
        }
    };
}

/// What a kind of parameter has besides its id and help; a part of [`params!`](crate::params!).
#[doc(hidden)]
#[macro_export]
macro_rules! param_kind {
    ($param:ident int $default:expr; $($range:tt)*) => {
        $param.r#type = $crate::private::abi::PTLP_PARAM_INT;
        $param.default_value = $default as f64;
        $crate::param_kind!(@range $param $($range)*);
    };
    ($param:ident float $default:expr; $($range:tt)*) => {
        $param.r#type = $crate::private::abi::PTLP_PARAM_FLOAT;
        $param.default_value = $default;
        $crate::param_kind!(@range $param $($range)*);
    };
    ($param:ident bool $default:expr;) => {
        $param.r#type = $crate::private::abi::PTLP_PARAM_FLAG;
        $param.default_value = $default as u8 as f64;
    };
    ($param:ident choice $default:expr; $choice:ident) => {
        $param.r#type = $crate::private::abi::PTLP_PARAM_CHOICE;
        $param.default_value = $default as u32 as f64;
        $param.choice_count = $crate::private::count($choice::IDS.len());
        $param.choice_ids = $choice::IDS.as_ptr();
        $param.choice_docs = $choice::DOCS.as_ptr();
    };
    ($param:ident text $default:expr;) => {
        $param.r#type = $crate::private::abi::PTLP_PARAM_TEXT;
        $param.default_text = concat!($default, "\0").as_ptr().cast();
    };
    ($param:ident path $default:expr; read) => {
        $param.r#type = $crate::private::abi::PTLP_PARAM_PATH;
        $param.flags = $crate::private::abi::PTLP_PARAM_READS_FILE;
        $param.default_text = concat!($default, "\0").as_ptr().cast();
    };
    ($param:ident path $default:expr; write) => {
        $param.r#type = $crate::private::abi::PTLP_PARAM_PATH;
        $param.default_text = concat!($default, "\0").as_ptr().cast();
    };
    (@range $param:ident hard $hlo:literal ..= $hhi:literal soft $slo:literal ..= $shi:literal $(unit $unit:literal)?) => {
        $param.min = $hlo as f64;
        $param.max = $hhi as f64;
        $param.soft_min = $slo as f64;
        $param.soft_max = $shi as f64;
        $($param.unit = concat!($unit, "\0").as_ptr().cast();)?
    };
}
