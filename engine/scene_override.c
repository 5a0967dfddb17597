/// `--set path=value`: a change of the case's tree before it is read, so that it is checked like
/// the file itself.
///
///     fluid.spacing_m=0.05      bodies[0].mass_kg=3      bodies.ship.mass_kg=3 waves.start=hot
///
/// An item of a list is named by its index or by its "name". Missing members (and objects between)
/// are created; the value `null` takes a member out.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene_case.h"

enum { STEP_SIZE = 64 };

/// One step of a path: a member's key (or an item's name), or an index.
typedef struct Step {
    char key[STEP_SIZE];
    int index; ///< -1 = by key
} Step;

/// Cut the next step off the path. @return false when it is not well formed
static bool next_step(const char **path, Step *step)
{
    const char *c = *path;
    step->index = -1;
    if (*c == '[') {
        char *end;
        long index = strtol(c + 1, &end, 10);
        if (end == c + 1 || *end != ']' || index < 0 || index > 100000) return false;
        step->index = (int)index;
        c = end + 1;
    } else {
        size_t length = strcspn(c, ".[");
        if (!length || length >= STEP_SIZE) return false;
        memcpy(step->key, c, length);
        step->key[length] = 0;
        c += length;
    }
    if (*c == '.' && (!c[1] || c[1] == '[' || c[1] == '.')) return false;
    if (*c && *c != '.' && *c != '[') return false;
    *path = *c == '.' ? c + 1 : c;
    return true;
}

/// Index of the item whose "name" is `name`, -1 when there is none.
static int item_named(const JsonValue *list, const char *name)
{
    int index = 0;
    for (const JsonValue *item = tree_first(list); item; item = tree_next(item), index++) {
        const JsonValue *own = tree_type(item) == JSON_OBJECT ? tree_member(item, "name") : NULL;
        if (own && tree_type(own) == JSON_TEXT && strcmp(tree_text(own), name) == 0) return index;
    }
    return -1;
}

/// Where a step leads from `at`: the child, or NULL when it is a member that does not exist yet.
static bool follow(JsonValue *at, Step *step, const char *assignment, JsonValue **child,
                   Error *error)
{
    *child = NULL;
    if (tree_type(at) == JSON_LIST) {
        if (step->index < 0) {
            step->index = item_named(at, step->key);
            if (step->index < 0)
                return error_set(
                    error, ERROR_INPUT,
                    "--set %s: nothing in this list is named \"%s\": must be a name or "
                    "[index], an index below %d",
                    assignment, step->key, tree_count(at));
        }
        *child = (JsonValue *)tree_item(at, step->index);
        return *child || error_set(error, ERROR_INPUT,
                                   "--set %s: index %d: must be >= 0 and < %d (items in the list)",
                                   assignment, step->index, tree_count(at));
    }
    if (tree_type(at) != JSON_OBJECT || step->index >= 0)
        return error_set(error, ERROR_INPUT,
                         "--set %s: the path leads through a value that is no %s", assignment,
                         step->index >= 0 ? "list" : "object");
    *child = (JsonValue *)tree_member(at, step->key);
    return true;
}

/// Put `value` (owned) where the last step points.
static bool put(JsonValue *at, const Step *step, JsonValue *value, const char *assignment,
                Error *error)
{
    if (tree_type(value) == JSON_NULL && step->index < 0) {
        tree_remove_member(at, step->key);
        tree_destroy(value);
        return true;
    }
    bool done = step->index >= 0 ? tree_put_item(at, step->index, value)
                                 : tree_put_member(at, step->key, value);
    return done || error_set(error, ERROR_SYSTEM, "--set %s: no memory", assignment);
}

static bool apply(JsonValue *root, const char *path, JsonValue *value, const char *assignment,
                  Error *error)
{
    JsonValue *at = root, *child;
    Step step;
    for (;;) {
        if (!next_step(&path, &step)) {
            tree_destroy(value);
            return error_set(error, ERROR_INPUT,
                             "--set %s: must be path=value, as fluid.spacing_m=0.05 or "
                             "bodies.ship.mass_kg=3",
                             assignment);
        }
        if (!follow(at, &step, assignment, &child, error)) {
            tree_destroy(value);
            return false;
        }
        if (!*path) return put(at, &step, value, assignment, error);
        if (!child) {
            JsonValue *object = tree_create_object();
            if (!object || !put(at, &step, object, assignment, error)) {
                tree_destroy(value);
                return error_set(error, ERROR_SYSTEM, "--set %s: no memory", assignment);
            }
            child = (JsonValue *)tree_member(at, step.key);
        }
        at = child;
    }
}

bool case_override(JsonValue *root, const char *assignment, Error *error)
{
    char path[JSON_PATH_SIZE];
    const char *equals = strchr(assignment, '=');
    size_t length = equals ? (size_t)(equals - assignment) : 0;
    if (!length || length >= sizeof path || !equals[1])
        return error_set(error, ERROR_INPUT,
                         "--set %s: must be path=value, as fluid.spacing_m=0.05", assignment);
    memcpy(path, assignment, length);
    path[length] = 0;
    JsonValue *value = tree_parse(equals + 1); // a bare word is a text
    if (!value) value = tree_create_text(equals + 1);
    if (!value) return error_set(error, ERROR_SYSTEM, "--set %s: no memory", assignment);
    return apply(root, path, value, assignment, error);
}
