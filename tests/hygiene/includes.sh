#!/usr/bin/env bash
# Each room includes only rooms before it, and each third-party header has its one place:
#     base <- physics <- backend <- engine <- render <- server
set -euo pipefail
. "$(dirname -- "$0")/files.sh"

own_files 'engine/*' 'render/*' 'server/*' | grep -E '\.(c|h|cu|cuh|def|inc)$' | awk '
function room_of(path) {
    if (path ~ /^engine\/base\//) return "base"
    if (path ~ /^engine\/physics\//) return "physics"
    if (path ~ /^engine\/backend\//) return "backend"
    if (path ~ /^engine\//) return "engine"
    if (path ~ /^render\//) return "render"
    return "server"
}
function base_name(path) { sub(/.*\//, "", path); return path }
function complain(text) { printf "%s:%d: %s\n", file, line, text; bad = 1 }

# The path in the tree that a quoted include means: beside the file, else as seen from a room.
function resolve(from, name,    beside, candidate, i) {
    beside = from
    sub(/[^\/]*$/, "", beside)
    if ((beside name) in known) return beside name
    for (i = 1; i <= split("engine/ render/ server/ engine/base/ engine/physics/ engine/backend/", folders, " "); i++) {
        candidate = folders[i] name
        if (candidate in known) return candidate
    }
    return ""
}

# May a file of this room include this path?
function allowed(from, path,    room) {
    room = room_of(path)
    if (room == from) return 1
    if (room == "base") return from != "physics" || path == "engine/base/portable.h"
    if (from == "base" || from == "physics") return 0
    if (from == "backend") return room == "physics" || room == "engine"
    if (from == "engine") return room == "physics" || path == "engine/backend/backend.h"
    if (path == "engine/engine.h") return 1
    return from == "server" && path == "render/render.h"
}

# Headers of others: [header pattern, files that may include it].
function foreign(name,    i) {
    for (i = 1; i <= place_count; i++)
        if (name ~ header[i]) {
            if (file !~ place[i]) complain("<" name "> belongs in " place[i])
            return
        }
    if (room_of(file) == "physics" && name != "math.h")
        complain("physics may include <math.h> only, not <" name ">")
}
function third_party(pattern, where) { header[++place_count] = pattern; place[place_count] = where }

BEGIN {
    third_party("^cjson/", "^engine/scene_[a-z_]*\\.[ch]$|^server/(json|protocol|explain)[a-z_]*\\.[ch]$")
    third_party("^EGL/", "^render/[a-z_]*egl[a-z_]*\\.[ch]$")
    third_party("^GL/osmesa", "^render/[a-z_]*osmesa[a-z_]*\\.[ch]$")
    third_party("^(GL|GLES[23]?|KHR)/", "^render/")
    third_party("^(png|turbojpeg|jpeglib)\\.h", "^render/")
    third_party("^libwebsockets", "^server/websocket\\.[ch]$")
    third_party("^(cuda|cub/|thrust/|curand|cooperative_groups)", "^engine/backend/cuda[a-z_]*\\.(cu|cuh)$")
}
{ known[$0] = 1; files[++file_count] = $0 }
END {
    for (f = 1; f <= file_count; f++) {
        file = files[f]
        line = 0
        while ((getline text < file) > 0) {
            line++
            if (text !~ /^[ \t]*#[ \t]*include/) continue
            if (match(text, /"[^"]+"/)) {
                name = substr(text, RSTART + 1, RLENGTH - 2)
                path = resolve(file, name)
                if (path == "") complain("\"" name "\" is not in the tree")
                else if (!allowed(room_of(file), path))
                    complain(room_of(file) " may not include " path)
            } else if (match(text, /<[^>]+>/))
                foreign(substr(text, RSTART + 1, RLENGTH - 2))
        }
        close(file)
    }
    printf "%d files looked at\n", file_count
    exit bad || !file_count
}'
