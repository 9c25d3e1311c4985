//! Values at the border to other languages: plug-ins and programs in C.
//!
//! `import` turns C structs from outside into checked values, `view` shows a value as C structs.
//! Both sides of the border use the structs of the crate `ptlib-plugin-abi`.

pub(crate) mod import;
pub(crate) mod view;
