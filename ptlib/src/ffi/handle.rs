//! Opaque handles: how a C pointer and a Rust object belong together.
//!
//! Every handle points to a [`Tagged`] object. The tag comes first in memory whatever the object
//! is, so a live handle of the wrong type is recognised before anything else is read, and a
//! released one usually is (its tag was wiped). Reference-counted handles are `Arc`s, the others
//! too: a call that is still running keeps its object when another thread releases the handle.
//!
//! Rejected: a table of handle numbers. It would recognise every stale handle, but cost a lock in
//! each call, and the calls that are made thousands of times a second are the cheap ones.

use std::{
    ops::Deref,
    sync::{
        Arc,
        atomic::{AtomicU32, Ordering},
    },
};

use super::argument::{Argument, Out};
use crate::error::{Error, ErrorKind};

/// What a released object's tag is.
const WIPED: u32 = 0;

/// An opaque type of the C header, and what its handles point to.
pub(super) trait Opaque {
    /// The object behind a handle.
    type Object;
    /// Tells the types apart; never [`WIPED`].
    const TAG: u32;
    /// The type's name in messages.
    const NAME: &'static str;
}

/// A tag that ends in `letter`; it is not [`WIPED`].
pub(super) const fn tag(letter: u8) -> u32 {
    u32::from_le_bytes([b'p', b't', b'l', letter])
}

/// An object with the tag of its type in front.
#[repr(C)]
#[derive(Debug)]
pub(super) struct Tagged<T> {
    tag: AtomicU32,
    value: T,
}

impl<T> Deref for Tagged<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T> Drop for Tagged<T> {
    fn drop(&mut self) {
        self.tag.store(WIPED, Ordering::Relaxed);
    }
}

/// An object for handles of type `T`.
pub(super) fn tagged<T: Opaque>(value: T::Object) -> Arc<Tagged<T::Object>> {
    Arc::new(Tagged { tag: AtomicU32::new(T::TAG), value })
}

/// A new handle: one reference that its receiver releases.
pub(super) fn give<T: Opaque>(object: Arc<Tagged<T::Object>>) -> *mut T {
    Arc::into_raw(object).cast_mut().cast()
}

/// A handle that lives as long as the object that holds `object`.
pub(super) fn lend<T: Opaque>(object: &Tagged<T::Object>) -> *const T {
    std::ptr::from_ref(object).cast()
}

/// A handle that a caller gave, for the time of the call.
#[derive(Debug)]
pub(super) struct Handle<'a, T: Opaque>(&'a Tagged<T::Object>);

impl<T: Opaque> Deref for Handle<'_, T> {
    type Target = T::Object;

    fn deref(&self) -> &T::Object {
        self.0
    }
}

impl<T: Opaque> Handle<'_, T> {
    /// One more reference to the object.
    ///
    /// # Safety
    /// The handle came from [`give`], not from [`lend`].
    pub(super) unsafe fn retain(&self) -> Arc<Tagged<T::Object>> {
        let object = std::ptr::from_ref(self.0);
        // SAFETY: `object` came from `Arc::into_raw` in `give` (the caller's promise) and is
        // alive, because `self` borrows it.
        unsafe { Arc::increment_strong_count(object) };
        // SAFETY: the same, and the reference made above is the one that this takes.
        unsafe { Arc::from_raw(object) }
    }

    /// The reference that the handle is, to be dropped.
    ///
    /// # Safety
    /// As [`retain`](Self::retain), and the caller never uses this reference again.
    pub(super) unsafe fn take(self) -> Arc<Tagged<T::Object>> {
        // SAFETY: `self.0` came from `Arc::into_raw` in `give`, and the caller gives it back.
        unsafe { Arc::from_raw(std::ptr::from_ref(self.0)) }
    }
}

impl<T: Opaque> Argument<*const T> for Handle<'_, T> {
    unsafe fn receive(raw: *const T, name: &'static str) -> Result<Self, Error> {
        let tag = raw.cast::<AtomicU32>();
        if tag.is_null() {
            return Err(super::argument::null(name));
        }
        if !tag.is_aligned() {
            return Err(not_a::<T>(name));
        }
        // SAFETY: not null, aligned, and a live handle of some type (the caller's promise), each
        // of which starts with its tag.
        let tag = unsafe { &*tag };
        if tag.load(Ordering::Relaxed) != T::TAG {
            return Err(not_a::<T>(name));
        }
        // SAFETY: only a live object that was made for handles of type `T` has this tag.
        Ok(Self(unsafe { &*raw.cast::<Tagged<T::Object>>() }))
    }
}

impl<T: Opaque> Argument<*mut T> for Handle<'_, T> {
    unsafe fn receive(raw: *mut T, name: &'static str) -> Result<Self, Error> {
        // SAFETY: the same promise.
        unsafe { <Self as Argument<*const T>>::receive(raw, name) }
    }
}

fn not_a<T: Opaque>(name: &str) -> Error {
    let message = format!("`{name}` is not a {}", T::NAME);
    Error::new(ErrorKind::InvalidArgument, message)
        .with_hint("a handle of another type, or one that was released?")
}

/// Where a new handle goes. It is NULL until [`set`](Self::set), so also after an error.
#[derive(Debug)]
pub(super) struct NewHandle<'a, T>(Out<'a, *mut T>);

impl<T: Opaque> NewHandle<'_, T> {
    /// Hands out the object.
    pub(super) fn set(self, object: Arc<Tagged<T::Object>>) {
        self.0.set(give::<T>(object));
    }
}

impl<T> Argument<*mut *mut T> for NewHandle<'_, T> {
    unsafe fn receive(raw: *mut *mut T, name: &'static str) -> Result<Self, Error> {
        // SAFETY: the same promise.
        let mut out = unsafe { <Out<'_, *mut T> as Argument<_>>::receive(raw, name) }?;
        out.put(std::ptr::null_mut());
        Ok(Self(out))
    }
}

/// Where a handle goes that lives as long as the object that holds its object. It is NULL until
/// [`set`](Self::set), so also after an error.
#[derive(Debug)]
pub(super) struct NewLoan<'a, T>(Out<'a, *const T>);

impl<T: Opaque> NewLoan<'_, T> {
    /// Lends the object.
    pub(super) fn set(self, object: &Tagged<T::Object>) {
        self.0.set(lend::<T>(object));
    }
}

impl<T> Argument<*mut *const T> for NewLoan<'_, T> {
    unsafe fn receive(raw: *mut *const T, name: &'static str) -> Result<Self, Error> {
        // SAFETY: the same promise.
        let mut out = unsafe { <Out<'_, *const T> as Argument<_>>::receive(raw, name) }?;
        out.put(std::ptr::null());
        Ok(Self(out))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug)]
    struct ptl_number;
    #[derive(Debug)]
    struct ptl_word;

    impl Opaque for ptl_number {
        type Object = Arc<u64>;
        const TAG: u32 = tag(b'1');
        const NAME: &'static str = "ptl_number";
    }

    impl Opaque for ptl_word {
        type Object = [u8; 3];
        const TAG: u32 = tag(b'2');
        const NAME: &'static str = "ptl_word";
    }

    fn receive<'a, T: Opaque>(raw: *const T) -> Result<Handle<'a, T>, Error> {
        // SAFETY: the tests give NULL or live handles.
        unsafe { Handle::receive(raw, "number") }
    }

    #[test]
    fn references_are_counted() {
        let content = Arc::new(7);
        let raw = give::<ptl_number>(tagged::<ptl_number>(Arc::clone(&content)));
        // SAFETY: `raw` was given.
        let more = give::<ptl_number>(unsafe { receive::<ptl_number>(raw).unwrap().retain() });
        assert_eq!(raw, more);
        // SAFETY: one of two references.
        drop(unsafe { receive(raw).unwrap().take() });
        assert_eq!(**receive(more).unwrap(), 7);
        assert_eq!(Arc::strong_count(&content), 2);
        // SAFETY: the last reference.
        drop(unsafe { receive(more).unwrap().take() });
        assert_eq!(Arc::strong_count(&content), 1);
    }

    #[test]
    fn what_is_no_handle_of_the_type_is_refused() {
        let error = receive::<ptl_number>(std::ptr::null()).unwrap_err();
        assert_eq!(error.message(), "`number` is NULL");
        let word = give::<ptl_word>(tagged::<ptl_word>(*b"abc"));
        let error = receive(word.cast::<ptl_number>()).unwrap_err();
        assert_eq!(error.message(), "`number` is not a ptl_number");
        let error = receive(word.wrapping_byte_add(1)).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        // SAFETY: the only reference.
        drop(unsafe { receive(word).unwrap().take() });
    }

    #[test]
    fn a_lent_handle_leads_to_its_object() {
        let word = tagged::<ptl_word>(*b"abc");
        assert_eq!(*receive(lend::<ptl_word>(&word)).unwrap(), *b"abc");
    }

    #[test]
    fn the_place_of_a_handle_is_null_until_it_is_set() {
        let mut place: *mut ptl_word = std::ptr::dangling_mut();
        // SAFETY: a place for a pointer.
        let out = unsafe { NewHandle::receive(&raw mut place, "out") };
        assert!(out.is_ok());
        assert!(place.is_null());
        // SAFETY: as above.
        let out = unsafe { NewHandle::receive(&raw mut place, "out") }.unwrap();
        out.set(tagged::<ptl_word>(*b"abc"));
        // SAFETY: the only reference.
        drop(unsafe { receive(place).unwrap().take() });
    }
}
