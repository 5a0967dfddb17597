#include "interrupt.h"

#include <pthread.h>
#include <stddef.h>

volatile sig_atomic_t interrupt_came;

static void on_signal(int number) { interrupt_came = number; }

void interrupt_catch(void)
{
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    signal(SIGPIPE, SIG_IGN); // a closed page or pipe is no reason to die
}

static void change_mask(int how)
{
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    pthread_sigmask(how, &set, NULL);
}

void interrupt_block(void) { change_mask(SIG_BLOCK); }
void interrupt_unblock(void) { change_mask(SIG_UNBLOCK); }
