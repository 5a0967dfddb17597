/// Which web pages may open a socket: only those that came from this very server.
#ifndef FAIRLEAD_ORIGIN_H
#define FAIRLEAD_ORIGIN_H

#include <stdbool.h>

/// Does an Origin header ("http://127.0.0.1:8080") name the same host and port as the Host header
/// ("127.0.0.1:8080")? Missing ports are the scheme's; "null" and other schemes never match.
bool origin_matches_host(const char *origin, const char *host);

/// Is it a name of this machine itself (localhost, 127.x.x.x, [::1]), any port? A server bound to
/// loopback refuses other names: a page elsewhere may have pointed its own name here.
bool host_is_loopback(const char *host);

#endif
