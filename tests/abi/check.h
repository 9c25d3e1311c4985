/* What the C programs of this folder share: checks that say where they failed. */
#ifndef PTLIB_TESTS_CHECK_H
#define PTLIB_TESTS_CHECK_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <ptlib/ptlib.h>

/* Ends the program unless `condition` holds. */
#define CHECK(condition) \
    do { \
        if (!(condition)) { \
            fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            exit(1); \
        } \
    } while (0)

static inline void expect(ptl_status status, ptl_status wanted, const ptl_error *error,
                          const char *part, const char *file, int line, const char *call)
{
    const char *message = ptl_error_message(error);
    const int says_part = part == NULL || (message != NULL && strstr(message, part) != NULL);
    const int fits = (error == NULL) == (status == PTL_OK || status == PTL_PENDING) &&
                     ptl_error_status(error) == (error == NULL ? PTL_OK : status);
    if (status != wanted || !says_part || !fits) {
        fprintf(stderr, "%s:%d: %s\n  gives %s, wanted %s\n  message: %s\n", file, line, call,
                ptl_status_name(status), ptl_status_name(wanted), message ? message : "none");
        exit(1);
    }
}

/* Ends the program unless `call` gives `wanted` and its error says `part`, which may be NULL.
 * Inside `call`, `&error` is where the error goes. */
#define EXPECT_MESSAGE(wanted, part, call) \
    do { \
        ptl_error *error = NULL; \
        const ptl_status status = (call); \
        expect(status, (wanted), error, (part), __FILE__, __LINE__, #call); \
        ptl_error_release(error); \
    } while (0)

#define EXPECT(wanted, call) EXPECT_MESSAGE(wanted, NULL, call)
#define OK(call) EXPECT(PTL_OK, call)

#endif
