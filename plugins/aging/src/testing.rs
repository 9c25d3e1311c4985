//! What tests share: the engine with this plug-in.

use ptlib::{Engine, EngineOptions};

/// An engine that has this plug-in, and no cache.
pub fn engine() -> Engine {
    let engine = Engine::new(EngineOptions { cache_bytes: 0, ..Default::default() });
    register(&engine);
    engine
}

/// Gives an engine this plug-in.
#[allow(unsafe_code, reason = "the tables of the plug-in are given as a pointer")]
pub fn register(engine: &Engine) {
    // SAFETY: the entry is a static of this crate, made by the SDK.
    unsafe { engine.register_plugin(&raw const super::ptl_plugin_entry_v1) }.unwrap();
}
