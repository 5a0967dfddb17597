#include "progress.h"

#include <math.h>
#include <unistd.h>

#include "mailbox.h"

enum { BAR_WIDTH = 30 };
static const double TERMINAL_INTERVAL = 0.2, LINE_INTERVAL = 5.0; ///< [s]

Progress progress_begin(FILE *out, bool quiet, double until)
{
    Progress progress = {.out = quiet ? NULL : out, .until = until};
    progress.terminal = isatty(fileno(out)) == 1;
    progress.began_at = progress.told_at = clock_seconds();
    return progress;
}

void progress_format_duration(double seconds, char *text, int size)
{
    long total = isfinite(seconds) ? (long)ceil(seconds) : 0;
    if (!isfinite(seconds) || seconds > 1e7)
        snprintf(text, (size_t)size, "long");
    else if (total >= 3600)
        snprintf(text, (size_t)size, "%ld h %02ld min", total / 3600, total / 60 % 60);
    else if (total >= 60)
        snprintf(text, (size_t)size, "%ld min %02ld s", total / 60, total % 60);
    else
        snprintf(text, (size_t)size, "%ld s", total);
}

static void tell(const Progress *progress, double now, double time, long long step)
{
    double elapsed = now - progress->began_at, fraction = time / progress->until;
    char left[32];
    fraction = fraction > 1 ? 1 : fraction;
    progress_format_duration(elapsed * (1 - fraction) / fraction, left, sizeof left);
    if (progress->terminal) {
        char bar[BAR_WIDTH + 1] = {0};
        for (int i = 0; i < BAR_WIDTH; i++)
            bar[i] = i < fraction * BAR_WIDTH ? '#' : '.';
        fprintf(progress->out, "\r[%s] %3.0f %%  t = %.2f of %.6g s  step %lld  %s left\033[K", bar,
                100 * fraction, time, progress->until, step, left);
    } else {
        fprintf(progress->out, "t = %.3f of %.6g s (%.0f %%), step %lld, %.3g s per s, %s left\n",
                time, progress->until, 100 * fraction, step, time / elapsed, left);
    }
    fflush(progress->out);
}

void progress_update(Progress *progress, double time, long long step)
{
    if (!progress->out) return;
    double now = clock_seconds();
    if (now - progress->told_at < (progress->terminal ? TERMINAL_INTERVAL : LINE_INTERVAL)) return;
    progress->told_at = now;
    tell(progress, now, time, step);
}

void progress_end(Progress *progress, double time, long long step)
{
    if (!progress->out) return;
    tell(progress, clock_seconds(), time, step);
    if (progress->terminal) fprintf(progress->out, "\n");
}
