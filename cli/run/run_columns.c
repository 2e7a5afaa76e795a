/* The columns of a run in an archive. See run.h. */
#include "cli/run/run.h"

#include "cli/model/load.h"
#include "cli/words/complain.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Returns how many columns of the CSV, from column k on, are all the numbers of a family, whose name goes to `base`;
 * 1 if they are not. */
static size_t family(const csv *c, size_t k, char base[], size_t size)
{
    motus_column column = motus_default_column();
    size_t first, count;
    motus_error none = motus_default_error();
    if (motus_column_at(c->model->system, c->columns[k], &column) != MOTUS_OK || column.dimensions == 0) return 1;
    snprintf(base, size, "%.*s%s", (int)strcspn(column.name, "["), column.name, column.is_velocity ? "'" : "");
    if (motus_column_find(c->model->system, base, &first, &count, &none) != MOTUS_OK || count > c->count - k) return 1;
    for (size_t i = 0; i < count; i++)
        if (c->columns[k + i] != first + i) return 1;
    return count;
}

/* Finds the shape of a family: {members, components}, {rows, columns} of a lattice, or {members, 0}. */
static void shape_of(const csv *c, size_t k, size_t count, size_t shape[2])
{
    motus_column first = motus_default_column(), last = motus_default_column();
    motus_column_at(c->model->system, c->columns[k], &first);
    motus_column_at(c->model->system, c->columns[k + count - 1], &last);
    const size_t components = (size_t)last.component + 1;
    const size_t second = last.dimensions == 2 ? (size_t)(last.cell[1] - first.cell[1] + 1) : 1;
    const size_t inner = components > 1 ? components : second;
    shape[0] = inner > 0 && count % inner == 0 ? count / inner : count;
    shape[1] = inner > 1 && count % inner == 0 ? inner : 0;
}

static void add(run_columns *r, const csv *c, const char *name, const char *more, size_t from, size_t width,
                const size_t *shape)
{
    run_column *own = r->columns + r->count;
    snprintf(own->name, sizeof own->name, "%s%s", name, more);
    own->from = from;
    own->width = width;
    char *comment = comments_find(c->model->text, own->name);
    if (comment) r->texts[r->text_count++] = comment;
    r->described[r->count++] = (motus_archive_column){.name = own->name,
                                                      .kind = MOTUS_ARCHIVE_NUMBER,
                                                      .shape = {shape ? shape[0] : 0, shape ? shape[1] : 0},
                                                      .comment = comment};
    r->width += width;
}

/* ---- H5MD ---- */

/* Joins three parts to a text that lives as long as the columns. A / in the name becomes another character, since it
 * would name a folder. Returns NULL if memory runs out. */
static const char *keep(run_columns *r, const char *before, const char *name, const char *behind)
{
    static const char slash[] = "\u2215";
    size_t length = strlen(before) + strlen(behind) + 1;
    for (const char *at = name; *at; at++) length += *at == '/' ? sizeof slash - 1 : 1;
    char *out = calloc(1, length);
    if (!out) return NULL;
    strcpy(out, before);
    for (const char *at = name; *at; at++) {
        const char one[] = {*at, 0};
        strcat(out, *at == '/' ? slash : one);
    }
    strcat(out, behind);
    r->texts[r->text_count++] = out;
    return out;
}

static bool link_to(run_columns *r, const char *before, const char *name, const char *behind, size_t column)
{
    const char *path = keep(r, before, name, behind);
    if (path) r->links[r->link_count++] = (motus_archive_link){path, column};
    return path;
}

static void say(run_columns *r, const char *group, const char *name, const char *text, const int *numbers, size_t count)
{
    r->attributes[r->attribute_count++] = (motus_archive_attribute){group, name, text, numbers, count};
}

/* Links an element of H5MD to its values, the numbers of the rows, and their times if the file has them. */
static bool element(run_columns *r, const char *group, const char *name, const char *what, size_t column, size_t time)
{
    char behind[64];
    bool good = true;
    const struct {
        const char *word;
        size_t column;
    } parts[] = {{"value", column}, {"step", MOTUS_ARCHIVE_SCALE}, {"time", time}};
    for (size_t k = 0; good && k < 3; k++) {
        if (k == 2 && time == r->count) continue;
        snprintf(behind, sizeof behind, "%s/%s", what, parts[k].word);
        good = link_to(r, group, name, behind, parts[k].column);
    }
    return good;
}

static bool particles(run_columns *r, const char *name, size_t column, bool velocity, size_t time)
{
    static const int dimension[] = {2, 3};
    const size_t d = r->described[column].shape[1];
    char plain[MOTUS_NAME_MAX] = "";
    snprintf(plain, sizeof plain, "%.*s", (int)strcspn(name, "'"), name);
    if (!element(r, "/particles/", plain, velocity ? "/velocity" : "/position", column, time)) return false;
    if (velocity) return true;
    const char *box = keep(r, "/particles/", plain, "/box");
    if (!box) return false;
    say(r, box, "dimension", NULL, dimension + (d - 2), 1);
    say(r, box, "boundary", "none", NULL, d);
    return true;
}

/* Gives column i the names of H5MD. */
static bool name_again(run_columns *r, const csv *c, size_t i, size_t time)
{
    motus_column first = motus_default_column();
    const run_column *own = r->columns + i;
    const size_t d = r->described[i].shape[1];
    if (own->from >= c->count) return true; /* it has errors, or is `significant` */
    motus_column_at(c->model->system, c->columns[own->from], &first);
    const bool position = first.kind == MOTUS_COLUMN_POSITION, velocity = first.kind == MOTUS_COLUMN_VELOCITY;
    if ((position || velocity) && first.dimensions == 1 && (d == 2 || d == 3))
        return particles(r, own->name, i, velocity, time);
    if (own->width == 1 && (first.kind == MOTUS_COLUMN_QUANTITY || first.kind == MOTUS_COLUMN_INVARIANT))
        return element(r, "/observables/", own->name, "", i, time);
    return true;
}

static bool conventions(run_columns *r, const csv *c)
{
    static const int version[] = {1, 1};
    size_t time = 0;
    while (time < r->count && !(r->columns[time].from < c->count && c->columns[r->columns[time].from] == 0)) time++;
    bool good = true;
    for (size_t i = 0; good && i < r->count; i++) good = name_again(r, c, i, time);
    say(r, "/h5md", "version", NULL, version, 2);
    say(r, "/h5md/author", "name", "motus", NULL, 0);
    say(r, "/h5md/creator", "name", "motus", NULL, 0);
    say(r, "/h5md/creator", "version", motus_version(), NULL, 0);
    return good;
}

motus_status run_columns_make(run_columns *r, const csv *c, motus_error *err)
{
    enum { EACH = 5 }; /* links and texts of a column, at most */
    const size_t most = 2 * c->count + 2;
    *r = (run_columns){.columns = calloc(most, sizeof *r->columns),
                       .described = calloc(most, sizeof *r->described),
                       .links = calloc(EACH * most, sizeof *r->links),
                       .attributes = calloc(2 * most + EACH, sizeof *r->attributes),
                       .texts = calloc(EACH * most, sizeof *r->texts)};
    if (!r->columns || !r->described || !r->links || !r->attributes || !r->texts) return complain_memory(err);
    for (int errors = 0; errors <= (c->errors ? 1 : 0); errors++)
        for (size_t k = 0, count; k < c->count; k += count) {
            char name[sizeof r->columns->name];
            size_t shape[2] = {0, 0};
            motus_column column = motus_default_column();
            count = family(c, k, name, sizeof name);
            if (count > 1) shape_of(c, k, count, shape);
            motus_column_at(c->model->system, c->columns[k], &column);
            if (errors && column.kind == MOTUS_COLUMN_TIME) continue;
            add(r, c, count > 1 ? name : column.name, errors ? ".error" : "", errors ? c->count + k : k, count, shape);
        }
    if (c->errors) add(r, c, "significant", "", SIZE_MAX, 1, NULL);
    return conventions(r, c) ? MOTUS_OK : complain_memory(err);
}

void run_columns_free(run_columns *r)
{
    for (size_t k = 0; k < r->text_count; k++) free(r->texts[k]);
    free(r->columns);
    free(r->described);
    free(r->links);
    free(r->attributes);
    free(r->texts);
    *r = (run_columns){0};
}

bool run_columns_fit(const run_columns *r, const motus_archive *a)
{
    bool same = motus_archive_column_count(a) == r->count;
    for (size_t k = 0; same && k < r->count; k++) {
        motus_archive_column c;
        motus_archive_column_at(a, k, &c);
        same = c.kind == MOTUS_ARCHIVE_NUMBER && motus_archive_width(&c) == r->columns[k].width &&
               strcmp(c.name, r->columns[k].name) == 0;
    }
    return same;
}

double **run_columns_rooms(const run_columns *r, size_t rows)
{
    double **rooms = calloc(r->count, sizeof *rooms);
    bool good = rooms;
    for (size_t k = 0; good && k < r->count; k++)
        good = (rooms[k] = calloc(rows * r->columns[k].width, sizeof **rooms));
    if (good) return rooms;
    run_columns_drop(r, rooms);
    return NULL;
}

void run_columns_drop(const run_columns *r, double **rooms)
{
    for (size_t k = 0; rooms && k < r->count; k++) free(rooms[k]);
    free(rooms);
}

void run_columns_put(const run_columns *r, const csv *plan, const double *values, double *const *rooms, size_t i)
{
    for (size_t k = 0; k < r->count; k++) {
        const run_column *c = r->columns + k;
        double *to = rooms[k] + i * c->width;
        if (c->from == SIZE_MAX)
            *to = csv_significant(plan, values);
        else
            memcpy(to, values + c->from, c->width * sizeof *to);
    }
}
