#include "origin.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { HOST_SIZE = 280 };

/// "host:port" with the scheme's port put in. @return false when it does not fit or is empty
static bool with_port(const char *host, const char *port, char full[HOST_SIZE])
{
    size_t length = strcspn(host, "/?# \t");
    const char *colon = memchr(host, ':', length);
    if (*host == '[') {
        const char *bracket = memchr(host, ']', length);
        if (!bracket) return false;
        colon = bracket[1] == ':' ? bracket + 1 : NULL;
    }
    if (!length || colon == host || host[length]) return false;
    int written = snprintf(full, HOST_SIZE, "%s%s%s", host, colon ? "" : ":", colon ? "" : port);
    return written < HOST_SIZE;
}

bool origin_matches_host(const char *origin, const char *host)
{
    static const struct {
        const char *prefix, *port;
    } schemes[] = {{"http://", "80"}, {"https://", "443"}};
    for (int i = 0; i < 2; i++) {
        size_t length = strlen(schemes[i].prefix);
        if (strncasecmp(origin, schemes[i].prefix, length) != 0) continue;
        char from[HOST_SIZE], here[HOST_SIZE];
        return with_port(origin + length, schemes[i].port, from) &&
               with_port(host, schemes[i].port, here) && !strcasecmp(from, here);
    }
    return false;
}

bool host_is_loopback(const char *host)
{
    char full[HOST_SIZE];
    if (!with_port(host, "0", full)) return false;
    *strrchr(full, ':') = 0;
    if (!strcasecmp(full, "localhost") || !strcmp(full, "[::1]")) return true;
    int parts[4], used = 0;
    return sscanf(full, "%3d.%3d.%3d.%3d%n", &parts[0], &parts[1], &parts[2], &parts[3], &used) ==
               4 &&
           !full[used] && parts[0] == 127;
}
