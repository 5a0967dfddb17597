/// Typed reading of JSON objects into structs by tables. A table says everything that an object of
/// the case file may hold: keys, types, units, accepted ranges and where each value goes. The same
/// tables are held against cases/schema.json by a test, both ways.
///
/// Rules for every object: unknown and repeated keys are refused (the nearest known key is named);
/// `notes`, a text or a list of texts, is allowed everywhere and read by nobody.
#ifndef FAIRLEAD_SCENE_TABLE_H
#define FAIRLEAD_SCENE_TABLE_H

#include <stdbool.h>
#include <stddef.h>

#include "scene_tree.h"

enum { JSON_PATH_SIZE = 160, FIELD_CHOICES_MAX = 8 };

typedef enum FieldKind {
    FIELD_NUMBER,   ///< double
    FIELD_INTEGER,  ///< int
    FIELD_NUMBERS,  ///< double[count_max]: a list of count_min or of count_max numbers
    FIELD_RANGE,    ///< Range: [smallest, largest]
    FIELD_POINT,    ///< Vec3: [x, y, z]; in 2-D also [x, z], and y becomes 0
    FIELD_POSITION, ///< Vec3: a point whose z may be left out (NAN): [x, y]; in 2-D [x]
    FIELD_TEXT,     ///< char[count_max], one line
    FIELD_NAME,     ///< char[count_max]: letters, digits, _ and -
    FIELD_CHOICE,   ///< int-sized enum: index into choices
    FIELD_OBJECT,   ///< members by `table`, into the same struct (offset)
    FIELD_LIST,     ///< objects by `table` into an array of structs, counted
    FIELD_CUSTOM,   ///< by `read`; `table` is what an object form of it may hold, NULL if none
} FieldKind;

struct CaseFile;
typedef struct JsonTable JsonTable;
typedef struct JsonField JsonField;

/// What reading needs everywhere.
typedef struct JsonReader {
    const char *file;       ///< path of the case, for messages
    struct CaseFile *draft; ///< everything read so far
    Error *error;
} JsonReader;

typedef bool (*FieldRead)(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                          const char *where, void *target);

struct JsonField {
    const char *key;
    FieldKind kind;
    bool required;
    bool above_min;                         ///< `min` itself is refused
    size_t offset;                          ///< of the value in the target struct [byte]
    double min, max;                        ///< accepted, in the unit of the file
    const char *unit;                       ///< "m", "s", "deg", …; NULL without
    double to_si;                           ///< factor; 0 counts as 1
    int count_min, count_max;               ///< numbers (or characters, or list items) accepted
    const char *choices[FIELD_CHOICES_MAX]; ///< ends with NULL
    const JsonTable *table;
    size_t item_size;      ///< FIELD_LIST [byte]
    size_t counter_offset; ///< FIELD_LIST: of the int that counts [byte]
    void (*item_default)(void *item);
    FieldRead read;
};

struct JsonTable {
    const JsonField *fields;
    int field_count;
    /// Called after the members were read: rules between them. May be NULL.
    bool (*finish)(const JsonReader *reader, const JsonValue *object, const char *where,
                   void *target);
};

/// Read the members of `object` into `target`; fields are read in the order of the table.
/// @param where  path of the object, "" for the top
/// @return false with ERROR_INPUT: "file: path = value: what is accepted"
bool table_read(const JsonReader *reader, const JsonTable *table, const JsonValue *object,
                const char *where, void *target);

/// Read one value by its field. @param where  path of the value
bool table_read_field(const JsonReader *reader, const JsonField *field, const JsonValue *value,
                      const char *where, void *target);

/// Refuse a value: "file: where = value: …"; without value: "file: where: …". @return false
bool table_refuse(const JsonReader *reader, const char *where, const JsonValue *value,
                  const char *format, ...) __attribute__((format(printf, 4, 5)));
/// The same for a number that was read before (in the unit of the file).
bool table_refuse_number(const JsonReader *reader, const char *where, double value,
                         const char *format, ...) __attribute__((format(printf, 4, 5)));

#endif
