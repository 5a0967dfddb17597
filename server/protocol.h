/// The wire, version 1 (docs/protocol.md), as pure functions: text in, struct out; struct in, text
/// out. Nothing here knows sockets, threads or files.
#ifndef FAIRLEAD_PROTOCOL_H
#define FAIRLEAD_PROTOCOL_H

#include "engine.h"
#include "json.h"
#include "render.h"
#include "status.h"

enum {
    PROTOCOL_VERSION = 1,
    PICTURE_HEADER_SIZE = 32,   ///< [byte]
    MESSAGE_SIZE_MAX = 1 << 16, ///< longest message from a client [byte]
};

typedef enum ClientMessageKind {
    MESSAGE_HELLO,
    MESSAGE_ACK,
    MESSAGE_VIEW,
    MESSAGE_CAMERA,
    MESSAGE_WAVE,
    MESSAGE_LINE,
    MESSAGE_RUN,
    MESSAGE_SNAPSHOT,
} ClientMessageKind;

typedef enum RunAction { ACTION_START, ACTION_PAUSE, ACTION_RESET } RunAction;

/// One message of a client; values that were not given hold what the comments say.
typedef struct ClientMessage {
    ClientMessageKind kind;
    uint32_t id; ///< of wave, line, run, snapshot
    uint32_t protocol;
    uint32_t frame;                      ///< of ack
    int width, height;                   ///< [pixel]; 0 = not given
    int water;                           ///< WaterMode; -1 = not given
    int field;                           ///< ColourField; -1 = not given
    int dark;                            ///< 0, 1; -1 = not given
    double azimuth, elevation, distance; ///< [rad], [m]; NAN = not given
    Vec3 target;                         ///< [m]; NANs = not given
    Command command;                     ///< of wave and line; NANs = not given
    int action;                          ///< RunAction
} ClientMessage;

/// Why a message was refused; becomes an `error` message.
typedef struct Refusal {
    bool has_id;
    uint32_t id;
    char path[64]; ///< "wave.height_m"; "" for the message as a whole
    char message[768];
} Refusal;

/// Read one text message. @param text  [length], need not be terminated
/// @return false with `refusal` filled: not JSON, unknown type or key, wrong kind of value, range
bool protocol_parse(const char *text, size_t length, ClientMessage *message, Refusal *refusal);

/// Take the given values of a `view` or `camera` message over into `view`.
void protocol_apply_view(const ClientMessage *message, ViewOptions *view);

/// What `hello` tells; everything borrowed.
typedef struct HelloInfo {
    const Scene *scene;
    const Plan *plan;
    const SeriesTable *columns;
    const ViewOptions *view;
    const char *version, *renderer;
    const char *warning; ///< of the server itself, or ""
} HelloInfo;

// Each appends one JSON message to `text`.
void protocol_format_hello(Text *text, const HelloInfo *info);
void protocol_format_status(Text *text, const SessionStatus *status, double frames_per_second,
                            int clients);
/// @param rows  [row_count][column_count]
void protocol_format_series(Text *text, const double *rows, int row_count, int column_count);
void protocol_format_marker(Text *text, double time, const char *words);
void protocol_format_accepted(Text *text, uint32_t id, double time);
void protocol_format_error(Text *text, const Refusal *refusal);
void protocol_format_reset(Text *text);
void protocol_format_view(Text *text, const ViewOptions *view);
void protocol_format_camera(Text *text, const Camera *camera);

typedef enum PictureKind { PICTURE_LIVE, PICTURE_STILL } PictureKind;
typedef struct PictureHeader {
    PictureKind kind;
    uint32_t number; ///< frame number or request id
    int width, height;
    double time; ///< simulated [s]
    size_t size; ///< of the encoded picture [byte]
} PictureHeader;
void protocol_format_picture_header(const PictureHeader *header,
                                    unsigned char bytes[PICTURE_HEADER_SIZE]);

/// A command read back from a journal line.
typedef struct JournalCommand {
    double time; ///< simulated [s]
    Command command;
} JournalCommand;

/// Read one line of journal.jsonl.
/// @param is_command  false for lines of another kind (start, health), which are skipped
/// @return false with ERROR_INPUT when the line is not a journal line
bool protocol_parse_journal(const char *line, bool *is_command, JournalCommand *command,
                            Error *error);

#endif
