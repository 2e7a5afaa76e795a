/* Structs that pass between the caller and the library: their defaults, and their size in each version. The words of
 * statuses and causes, too.
 *
 * Invariants: the layout of a version begins with the layout of the version before, padding included; what it adds
 * has no padding (which an assignment by the caller need not copy) and means "as before" where it is zero. So a
 * struct of an older caller is the beginning of ours, and a struct of a newer caller is ours and zeros, unless it
 * sets a member that this library does not have. Where a member counts what another points to, a definition that was
 * read has an array as soon as the count is above 0, and no text in it is NULL.
 */
#include "api/system/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* A version that adds members adds its size at the end; the last one is the present size. */
#define SIZES(type) (const uint32_t[]){sizeof(type)}, 1

typedef struct layout {
    const char *type, *maker;
    const uint32_t *sizes;
    size_t count;
    const void *start; /* the defaults, but for the size; NULL: zeros */
} layout;

/* The defaults of a type: the members that are not 0. */
#define LAYOUT(type, maker, sizes, ...)                       \
    {                                                         \
        "" #type, maker, sizes, &(const type) { __VA_ARGS__ } \
    }

static const layout layouts[] = {
    [MOTUS_DEF_ERROR] = {"motus_error", "error", SIZES(motus_error), NULL},
    [MOTUS_DEF_TEXT] = LAYOUT(motus_text_def, "text", SIZES(motus_text_def), .length = SIZE_MAX),
    [MOTUS_DEF_CALLBACK] = LAYOUT(motus_callback_def, "callback", SIZES(motus_callback_def), .quantities = 1,
                                  .invariants = 1, .depends_on_velocity = 1, .depends_on_time = 1),
    [MOTUS_DEF_RUN] = LAYOUT(motus_run_def, "run", SIZES(motus_run_def), .switches = MOTUS_SWITCHES_USUAL, .step = NAN,
                             .accuracy = NAN, .tolerance = NAN, .until = NAN, .start = NAN),
    [MOTUS_DEF_STUDY] = LAYOUT(motus_study_def, "study", SIZES(motus_study_def), .step = NAN, .until = NAN,
                               .coarsest = NAN, .finest = NAN),
    [MOTUS_DEF_ENSEMBLE] = LAYOUT(motus_ensemble_def, "ensemble", SIZES(motus_ensemble_def), .step = NAN, .until = NAN,
                                  .tolerance = NAN, .accuracy = NAN, .every = 1, .switches = MOTUS_SWITCHES_USUAL),
    [MOTUS_DEF_VARIABLE] = {"motus_variable", "variable", SIZES(motus_variable), NULL},
    [MOTUS_DEF_COLUMN] = {"motus_column", "column", SIZES(motus_column), NULL},
    [MOTUS_DEF_PARAMETER] = {"motus_parameter", "parameter", SIZES(motus_parameter), NULL},
    [MOTUS_DEF_INITIAL] = {"motus_initial", "initial", SIZES(motus_initial), NULL},
    [MOTUS_DEF_SETTINGS] = LAYOUT(motus_settings, "settings", SIZES(motus_settings), .step = NAN, .from = NAN,
                                  .until = NAN, .tolerance = NAN, .accuracy = NAN, .every_time = NAN),
    [MOTUS_DEF_ANALYSIS] = {"motus_analysis", "analysis", SIZES(motus_analysis), NULL},
    [MOTUS_DEF_STATEMENT] = {"motus_statement", "statement", SIZES(motus_statement), NULL},
    [MOTUS_DEF_RUN_STATISTICS] = LAYOUT(
        motus_run_statistics, "run_statistics", SIZES(motus_run_statistics), .method = "", .machine = "", .choice = "",
        .note = "", .not_located = "", .cut = "", .step = NAN, .first_step = NAN, .last_step = NAN, .tolerance = NAN,
        .accuracy = NAN, .reached = NAN, .shortest_step = NAN, .longest_step = NAN, .jump = -1, .compiled_from = -1,
        .events_unseen_from = NAN, .events_unseen_of = "", .events_held_of = "", .jump_time = NAN, .jump_power = NAN),
    [MOTUS_DEF_ESTIMATE] = LAYOUT(motus_estimate, "estimate", SIZES(motus_estimate), .significant_until = NAN,
                                  .rate = NAN, .work = NAN, .reason = "", .looked = NAN),
    [MOTUS_DEF_EVENT_ROW] =
        LAYOUT(motus_event_row, "event_row", SIZES(motus_event_row), .name = "", .time = NAN, .error = NAN),
    [MOTUS_DEF_SWITCH] =
        LAYOUT(motus_switch, "switch", SIZES(motus_switch), .operation = "", .surface = "", .not_located = ""),
    [MOTUS_DEF_ENSEMBLE_STATISTICS] =
        LAYOUT(motus_ensemble_statistics, "ensemble_statistics", SIZES(motus_ensemble_statistics), .method = "",
               .machine = "", .note = "", .not_located = "", .tolerance = NAN, .accuracy = NAN, .compiled_from = -1,
               .lanes = 1, .threads = 1, .switches = MOTUS_SWITCHES_USUAL)};

static uint32_t size_now(const layout *l) { return l->sizes[l->count - 1]; }

static uint32_t size_said(const void *made)
{
    uint32_t size;
    memcpy(&size, made, sizeof size);
    return size;
}

void motus_default(motus_def_kind kind, void *made, uint32_t size)
{
    memset(made, 0, size);
    if ((unsigned)kind >= sizeof layouts / sizeof *layouts || size < sizeof size) return;
    const layout *l = &layouts[kind];
    if (l->start) memcpy(made, l->start, size < size_now(l) ? size : size_now(l));
    if (kind == MOTUS_DEF_ERROR && size >= offsetof(motus_error, time) + sizeof(double))
        ((motus_error *)made)->time = NAN; /* not by `start`, because nearly all of an error is room for texts */
    memcpy(made, &size, sizeof size);
}

/* An array that a definition points to, and the member that counts it. */
typedef struct list {
    motus_def_kind of;
    const char *name;
    size_t array, count;
    bool texts;    /* of texts; else of numbers or structs */
    bool may_lack; /* NULL has a meaning of its own, whatever the count is */
} list;

#define LIST(KIND, type, array, count, ...)                                                 \
    {                                                                                       \
        MOTUS_DEF_##KIND, #array, offsetof(type, array), offsetof(type, count), __VA_ARGS__ \
    }
static const list lists[] = {
    LIST(TEXT, motus_text_def, set, set_count, true, false),
    LIST(TEXT, motus_text_def, when, when_count, true, false),
    LIST(TEXT, motus_text_def, define, define_count, true, false),
    LIST(CALLBACK, motus_callback_def, events, event_count, false, false),
    LIST(ENSEMBLE, motus_ensemble_def, vary, vary_count, true, false),
    LIST(ENSEMBLE, motus_ensemble_def, records, record_count, false, false),
    LIST(ENSEMBLE, motus_ensemble_def, event_columns, event_column_count, false, false),
    LIST(STUDY, motus_study_def, methods, method_count, true, true),
};

/* ---- sizes ---- */

/* No version of any struct is larger: a size beyond it was never filled in. */
enum { SIZE_BOUND = 1 << 14 };

defaults_fit defaults_judge(const uint32_t *sizes, size_t count, const void *made)
{
    const uint32_t size = size_said(made), now = sizes[count - 1];
    const unsigned char *bytes = made;
    if (size == 0) return SIZE_MISSING;
    for (size_t i = 0; i < count; i++)
        if (sizes[i] == size) return SIZE_FITS;
    if (size < now || size > SIZE_BOUND) return SIZE_UNKNOWN;
    for (uint32_t i = now; i < size; i++)
        if (bytes[i]) return SIZE_ASKS_MORE;
    return SIZE_FITS;
}

static motus_status refuse(const layout *l, defaults_fit fit, uint32_t size, motus_error *err)
{
    if (fit == SIZE_ASKS_MORE) {
        fail(err, MOTUS_ARGUMENT, "the %s sets a member that motus %s does not have", l->type, MOTUS_VERSION);
        hint(err, "leave the new members as motus_default_%s() makes them, or load a newer motus", l->maker);
        return MOTUS_ARGUMENT;
    }
    if (fit == SIZE_MISSING)
        fail(err, MOTUS_ARGUMENT, "the %s has no size", l->type);
    else
        fail(err, MOTUS_ARGUMENT, "the %s has a size that no version had, %lu bytes", l->type, (unsigned long)size);
    hint(err, "make it with motus_default_%s()", l->maker);
    return MOTUS_ARGUMENT;
}

motus_status motus_struct_check(motus_def_kind kind, const void *made, motus_error *err)
{
    const layout *l = &layouts[kind];
    const defaults_fit fit = defaults_judge(l->sizes, l->count, made);
    return fit == SIZE_FITS ? MOTUS_OK : refuse(l, fit, size_said(made), err);
}

/* Writes a refusal to the error itself, which has the members of the first version whatever its size is. */
bool motus_error_sound(motus_error *err) { return !err || motus_struct_check(MOTUS_DEF_ERROR, err, err) == MOTUS_OK; }

static void copy(motus_def_kind kind, void *to, const void *from, uint32_t size)
{
    const uint32_t now = size_now(&layouts[kind]), most = size < now ? size : now;
    memcpy((char *)to + sizeof size, (const char *)from + sizeof size, most - sizeof size);
}

/* Checks that a definition has the array that its count promises. */
static motus_status check_list(const list *l, const void *ours, motus_error *err)
{
    const void *array;
    size_t count;
    memcpy(&array, (const char *)ours + l->array, sizeof array);
    memcpy(&count, (const char *)ours + l->count, sizeof count);
    if (count > 0 && !array && !l->may_lack) {
        fail(err, MOTUS_ARGUMENT, "`%s` of the %s is NULL, and its count is %zu", l->name, layouts[l->of].type, count);
        hint(err, "give the array, or the count 0");
        return MOTUS_ARGUMENT;
    }
    for (size_t k = 0; array && l->texts && k < count; k++)
        if (!((const char *const *)array)[k])
            return fail(err, MOTUS_ARGUMENT, "text %zu of `%s` of the %s is NULL", k + 1, l->name, layouts[l->of].type);
    return MOTUS_OK;
}

motus_status motus_struct_read(motus_def_kind kind, const void *given, void *ours, motus_error *err)
{
    motus_default(kind, ours, size_now(&layouts[kind]));
    motus_status status = given ? motus_struct_check(kind, given, err) : MOTUS_OK;
    if (given && status == MOTUS_OK) copy(kind, ours, given, size_said(given));
    for (size_t k = 0; given && status == MOTUS_OK && k < sizeof lists / sizeof *lists; k++)
        if (lists[k].of == kind) status = check_list(&lists[k], ours, err);
    return status;
}

void motus_struct_write(motus_def_kind kind, const void *ours, void *to) { copy(kind, to, ours, size_said(to)); }

/* ---- words ---- */

#define CAUSE_WORD(name, word) word,
static const char *const causes[] = {MOTUS_CAUSE_MAP(CAUSE_WORD)};

const char *motus_cause_word(motus_cause c) { return causes[(unsigned)c < MOTUS_CAUSE_COUNT ? (unsigned)c : 0]; }

const char *motus_version(void) { return MOTUS_VERSION; }

#define STATUS_ROW(name, word, text, exit) {word, text, exit},
static const struct {
    const char *word, *text;
    int exit;
} statuses[] = {MOTUS_STATUS_MAP(STATUS_ROW)};

static size_t known(motus_status s) { return (unsigned)s < MOTUS_STATUS_COUNT ? (size_t)s : MOTUS_ARGUMENT; }

const char *motus_status_word(motus_status s) { return statuses[known(s)].word; }
const char *motus_status_text(motus_status s) { return statuses[known(s)].text; }
int motus_status_exit(motus_status s) { return statuses[known(s)].exit; }

motus_line motus_error_line(const motus_error *given)
{
    motus_error err, why = motus_default_error();
    motus_line line;
    char place[64] = "";
    if (motus_struct_read(MOTUS_DEF_ERROR, given, &err, &why) != MOTUS_OK) err = why;
    if (err.line > 0)
        snprintf(place, sizeof place, err.file[0] ? ":%d:%d: " : "line %d, column %d: ", err.line, err.column);
    if (err.file[0] && !err.line) memcpy(place, ": ", sizeof ": ");
    snprintf(line.text, sizeof line.text, "%s%s%s%s%s", err.file, place, err.message, err.hint[0] ? "; hint: " : "",
             err.hint);
    return line;
}
