/// Bad input and failed systems travel as values: functions that can fail return bool, take an
/// `Error *` last and fill it exactly once, at the place where the failure is understood.
#ifndef FAIRLEAD_BASE_ERROR_H
#define FAIRLEAD_BASE_ERROR_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What kind of failure it was; decides the exit code of the program.
typedef enum ErrorCode {
    ERROR_NONE = 0,
    ERROR_INPUT,   ///< a case, command or file that is not acceptable (exit 2)
    ERROR_SYSTEM,  ///< the machine refused: memory, disk, socket, GPU (exit 2)
    ERROR_PHYSICS, ///< sick physics that roll-back could not cure (exit 3)
} ErrorCode;

typedef struct Error {
    ErrorCode code;
    char message[768]; ///< one line: where (JSON path or file), what was found, what is accepted
} Error;

/// Fill `error` (may be NULL) with a formatted line; newlines become spaces.
/// @return always false, so that `return error_set(...)` reads as a failure
bool error_set(Error *error, ErrorCode code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/// Pass a failure up: the arena owns what was built, so there is nothing to unwind.
#define TRY(call)                                                                                  \
    do {                                                                                           \
        if (!(call)) return false;                                                                 \
    } while (0)

/// A programmer's mistake: prints file, line and condition, then aborts.
void assert_failed(const char *file, int line, const char *condition);
#define ASSERT(condition)                                                                          \
    do {                                                                                           \
        if (!(condition)) assert_failed(__FILE__, __LINE__, #condition);                           \
    } while (0)

#ifdef __cplusplus
}
#endif
#endif
