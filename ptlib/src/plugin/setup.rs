//! What an instance is prepared from, as a plug-in sees it.

use std::{
    ffi::{CString, c_char},
    ptr,
};

use ptlib_plugin_abi::*;

use super::wires::Wires;
use crate::{
    block::Context,
    error::{Error, ErrorKind},
    math::{convert::count, levels::Precision},
    params::ParamValue,
};

/// A [`ptlp_setup`] with all that it leads to. Pointers lead from one box to another, so the object
/// may be moved.
pub(super) struct Setup {
    raw: ptlp_setup,
    inputs: Wires,
    _values: Box<[ptlp_value]>,
    _pointers: Box<[*const ptlp_value]>,
    _texts: Vec<CString>,
}

// SAFETY: the pointers lead to boxes of the same object, which nobody changes.
unsafe impl Send for Setup {}
// SAFETY: as above.
unsafe impl Sync for Setup {}

impl Setup {
    /// # Errors
    /// [`ErrorKind::InvalidArgument`] for a text with a NUL, which C cannot have.
    pub(super) fn new(
        values: &[ParamValue],
        precision: Precision,
        cx: &Context<'_>,
    ) -> Result<Self, Error> {
        let size = (cx.width, cx.height);
        let inputs = Wires::of_inputs(cx.inputs, cx.planes.inputs, size);
        Self::with(values, precision, size, cx.seed, inputs)
    }

    /// For a question that is asked before inputs are there.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub(super) fn without_inputs(
        values: &[ParamValue],
        width: u32,
        height: u32,
    ) -> Result<Self, Error> {
        let none = Wires::of_inputs(&[], &[], (width, height));
        Self::with(values, Precision::Float, (width, height), 0, none)
    }

    /// # Errors
    /// As [`new`](Self::new).
    pub(super) fn with(
        values: &[ParamValue],
        precision: Precision,
        (width, height): (u32, u32),
        seed: u64,
        inputs: Wires,
    ) -> Result<Self, Error> {
        let mut texts = Vec::new();
        let values = values.iter().map(|value| to_c(value, &mut texts));
        let values: Box<[ptlp_value]> = values.collect::<Result<_, _>>()?;
        let pointers: Box<[*const ptlp_value]> = values.iter().map(ptr::from_ref).collect();
        let raw = ptlp_setup {
            struct_size: count(size_of::<ptlp_setup>()),
            flags: 0,
            width,
            height,
            precision: match precision {
                Precision::EightBit => PTLP_PRECISION_8BIT,
                Precision::Float => PTLP_PRECISION_FLOAT,
            },
            value_count: count(values.len()),
            input_count: count(inputs.pointers().len()),
            reserved0: 0,
            seed,
            values: pointers.as_ptr(),
            inputs: inputs.pointers().as_ptr(),
        };
        Ok(Self { raw, inputs, _values: values, _pointers: pointers, _texts: texts })
    }

    /// The setup, for as long as the object lives.
    pub(super) fn raw(&self) -> &ptlp_setup {
        &self.raw
    }

    /// What is at the inputs, one pointer a port.
    #[inline]
    pub(super) fn inputs(&self) -> &[*const ptlp_wire] {
        self.inputs.pointers()
    }
}

fn to_c(value: &ParamValue, texts: &mut Vec<CString>) -> Result<ptlp_value, Error> {
    let whole = |r#type, integer: i64| ptlp_value {
        r#type,
        reserved0: 0,
        integer,
        number: integer as f64,
        text: ptr::null(),
        reserved1: ptr::null(),
    };
    Ok(match value {
        ParamValue::Int(value) => whole(PTLP_PARAM_INT, (*value).into()),
        ParamValue::Bool(value) => whole(PTLP_PARAM_FLAG, (*value).into()),
        ParamValue::Choice(value) => whole(PTLP_PARAM_CHOICE, (*value).into()),
        ParamValue::Float(value) => ptlp_value { number: *value, ..whole(PTLP_PARAM_FLOAT, 0) },
        ParamValue::Text(text) => {
            let text = CString::new(&**text).map_err(|error| {
                let message = format!("a text has a NUL at byte {}", error.nul_position());
                Error::new(ErrorKind::InvalidArgument, message)
            })?;
            let start: *const c_char = text.as_ptr();
            texts.push(text);
            ptlp_value { text: start, ..whole(PTLP_PARAM_TEXT, 0) }
        }
    })
}
