/// SIGINT and SIGTERM as a flag: the main loop looks at it and ends in good order.
#ifndef FAIRLEAD_INTERRUPT_H
#define FAIRLEAD_INTERRUPT_H

#include <signal.h>

/// Catch both signals; a second one of the same kind ends the program at once.
void interrupt_catch(void);
/// Set by the first signal.
extern volatile sig_atomic_t interrupt_came;

/// Threads started between block and unblock never take the signals: they reach the main thread.
void interrupt_block(void);
void interrupt_unblock(void);

#endif
