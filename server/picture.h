/// The render thread: it alone owns the GL context. Turns the newest snapshot into the newest
/// picture while somebody watches, as often as the solver can afford (pace.h).
#ifndef FAIRLEAD_PICTURE_H
#define FAIRLEAD_PICTURE_H

#include "protocol.h"
#include "session.h"

/// Free bytes before a picture's header, so that the socket can frame it without a copy.
enum { PICTURE_HEADROOM = 32 };

/// An encoded picture, shared by all clients that still send it.
typedef struct Picture {
    atomic_int references;
    uint32_t number;       ///< frame number or request id
    size_t size;           ///< header and payload [byte]
    unsigned char bytes[]; ///< [PICTURE_HEADROOM + size]
} Picture;

Picture *picture_retain(Picture *picture);
void picture_release(Picture *picture);

typedef struct Pictures Pictures;

/// Start the render thread and wait until its GL context is there.
/// A machine without GL is no reason to stop: pictures_renderer then says why there are none.
Pictures *pictures_create(Session *session, const ViewOptions *view, Wake wake, Error *error);
/// Stop the thread; what others ask afterwards is not answered.
void pictures_stop(Pictures *pictures);
void pictures_destroy(Pictures *pictures);

/// "EGL …" or "none: <reason>"; constant.
const char *pictures_renderer(const Pictures *pictures);
bool pictures_available(const Pictures *pictures);

void pictures_set_view(Pictures *pictures, const ViewOptions *view);
/// Somebody watches and has shown the last frame. @param lagging  acknowledgements come late
void pictures_set_demand(Pictures *pictures, bool wanted, bool lagging);
/// Number of the newest live picture, 0 before the first.
uint32_t pictures_newest(Pictures *pictures);
/// The newest live picture, retained for the caller; NULL before the first.
Picture *pictures_latest(Pictures *pictures);
/// Live frames per second over the last seconds.
double pictures_rate(Pictures *pictures);

/// A still for one client.
typedef struct StillRequest {
    uint64_t client;
    uint32_t id;
    int width, height; ///< [pixel]
} StillRequest;
typedef struct StillReply {
    uint64_t client;
    uint32_t id;
    Picture *picture; ///< owned by the taker; NULL: `message` says why
    char message[768];
} StillReply;
/// @return false when too many wait
bool pictures_ask_still(Pictures *pictures, const StillRequest *request);
bool pictures_next_still(Pictures *pictures, StillReply *reply);

#endif
