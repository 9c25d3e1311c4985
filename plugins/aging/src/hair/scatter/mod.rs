//! How hairs are scattered: the ground they grow on, how many each triangle has, their order and
//! their directions.

pub mod batch;
pub mod candidates;
pub mod ground;
pub mod lean;
pub mod order;
