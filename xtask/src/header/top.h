/*
 * ptlib: an engine for procedural textures. The C interface.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 *
 * Generated from ptlib/src/ffi by `cargo xtask header`: do not edit.
 *
 * The rules that hold for every function:
 *
 * Statuses. Every call that can fail returns a ptl_status, 0 (PTL_OK) for success. It usually takes
 * a `ptl_error **` last, which may be NULL. If it is not, the call always writes it: NULL, or a new
 * error that tells more and that you release with ptl_error_release(). Other outputs are written as
 * the function says: handles become NULL on error, everything else stays untouched.
 *
 * Handles are opaque. Engines, graphs, images, values and cancel requests are reference counted:
 * ptl_..._retain() adds a reference, ptl_..._release() gives one up. Errors, bytes and jobs have
 * one owner, who releases them. Every release takes NULL, on any thread and in any order: what is
 * still needed inside is kept alive. A handle must not be used after its last reference was
 * released. Handles of the wrong type are refused with PTL_E_INVALID_ARGUMENT.
 *
 * Threads. A `const` handle may be used by several threads at once. A handle that is not const is
 * used by one thread at a time; that is checked where it matters (PTL_E_BUSY).
 *
 * Texts that go in are UTF-8 and end with NUL. Texts that come out are UTF-8 and borrowed: they
 * live as long as the object that the function's documentation names.
 *
 * Structs start with `struct_size`, the size that your program was built with: set it, or let the
 * PTL_..._INIT macros do it. They only grow at their ends. The library takes smaller structs (the
 * missing fields are 0), and larger ones if what it does not know is 0, else PTL_E_UNSUPPORTED.
 * Fields that are 0 always mean "as usual". In structs that a function fills in, what the library
 * does not know becomes 0.
 *
 * The library never ends the program, installs no signal handlers, and prints nothing; only a
 * defect inside, which is returned as PTL_E_INTERNAL, also leaves a message on stderr.
 *
 * Define PTL_STATIC before including this file if you link the static library on Windows. Link at
 * most one static Rust library into a program; otherwise use the shared one.
 */
#ifndef PTLIB_H
#define PTLIB_H

#include <stddef.h>
#include <stdint.h>

#include "ptlib_values.h"

#define PTL_VERSION_MAJOR @MAJOR@
#define PTL_VERSION_MINOR @MINOR@
#define PTL_VERSION_PATCH @PATCH@
/* The version of this header; ptl_version_number() is that of the library. */
#define PTL_VERSION_NUMBER \
    (PTL_VERSION_MAJOR * 1000000 + PTL_VERSION_MINOR * 1000 + PTL_VERSION_PATCH)

#if defined(_WIN32) && !defined(_WIN64)
#  define PTL_CALL __cdecl
#else
#  define PTL_CALL
#endif
#if defined(_WIN32) && !defined(PTL_STATIC)
#  define PTL_API __declspec(dllimport)
#else
#  define PTL_API
#endif
#if defined(__GNUC__)
#  define PTL_MUST_USE __attribute__((warn_unused_result))
#else
#  define PTL_MUST_USE
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* A plug-in that is linked into the program: see ptlib_plugin.h. */
struct ptlp_entry;

