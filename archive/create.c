/* Makes an archive, by the module that knows HDF5. See make.h. */
#include "archive/make.h"
#include "base/error.h"

#include <dlfcn.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static bool one_line(const char *text) { return text && *text && !strchr(text, '\n') && strcmp(text, ".") != 0; }

/* Tells whether the archive that is to be compressed has these blocks and columns. */
static bool same_shape(const motus_archive_def *d)
{
    uint64_t first;
    size_t count;
    motus_archive_block(d->from, 0, &first, &count);
    bool same = motus_archive_rows(d->from) == d->rows && motus_archive_slot(d->from) == d->slot &&
                motus_archive_column_count(d->from) == d->column_count &&
                count == (d->rows < d->block ? d->rows : d->block);
    for (size_t k = 0; same && k < d->column_count; k++) {
        const motus_archive_column *c = d->columns + k;
        motus_archive_column its;
        motus_archive_column_at(d->from, k, &its);
        same = its.kind == c->kind && its.shape[0] == c->shape[0] && its.shape[1] == c->shape[1] &&
               strcmp(its.name, c->name) == 0;
    }
    return same;
}

static bool lacks(const void *array, size_t count) { return count > 0 && !array; }

static motus_status check(const motus_archive_def *d, motus_error *err)
{
    if (d->size != sizeof *d) {
        fail(err, MOTUS_ARGUMENT, "the size in motus_archive_def is wrong: %u, not %zu", d->size, sizeof *d);
        hint(err, "begin with motus_archive_default()");
        return MOTUS_ARGUMENT;
    }
    const char *const missing = lacks(d->columns, d->column_count)         ? "columns"
                                : lacks(d->notes, d->note_count)           ? "notes"
                                : lacks(d->links, d->link_count)           ? "links"
                                : lacks(d->attributes, d->attribute_count) ? "attributes"
                                                                           : NULL;
    if (missing)
        return fail(err, MOTUS_ARGUMENT, "`%s` of the motus_archive_def is NULL, and its count is not 0", missing);
    if (d->block == 0 || d->column_count == 0)
        return fail(err, MOTUS_ARGUMENT, "an archive has blocks of at least one row, and a column");
    if (d->rows > INT64_MAX / 16 || d->block > SIZE_MAX / sizeof(double))
        return fail(err, MOTUS_LIMIT, "an archive has at most %lld rows", (long long)(INT64_MAX / 16));
    if (!one_line(d->group) || strchr(d->group, '/') || strcmp(d->group, "blocks") == 0 || !one_line(d->scale))
        return fail(err, MOTUS_ARGUMENT, "the group or the scale of an archive has no proper name");
    for (size_t k = 0; k < d->column_count; k++) {
        const motus_archive_column *c = d->columns + k;
        if (!one_line(c->name)) return fail(err, MOTUS_ARGUMENT, "column %zu of an archive has no proper name", k);
        if (c->kind != MOTUS_ARCHIVE_NUMBER && (c->kind != MOTUS_ARCHIVE_WORD || c->word_count > 255))
            return fail(err, MOTUS_ARGUMENT, "column %s is neither of numbers nor of up to 255 words", c->name);
        if (c->kind == MOTUS_ARCHIVE_WORD ? c->shape[0] || c->shape[1] : c->shape[1] && !c->shape[0])
            return fail(err, MOTUS_ARGUMENT, "column %s has no proper shape", c->name);
        if (c->shape[0] > INT32_MAX || c->shape[1] > INT32_MAX)
            return fail(err, MOTUS_LIMIT, "column %s has too many numbers in a row", c->name);
        if (c->comment && !one_line(c->comment))
            return fail(err, MOTUS_ARGUMENT, "the comment of column %s is not one line", c->name);
        for (size_t w = 0; c->kind == MOTUS_ARCHIVE_WORD && w < c->word_count; w++)
            if (!c->words || !c->words[w] || strchr(c->words[w], '\n'))
                return fail(err, MOTUS_ARGUMENT, "word %zu of column %s is missing, or has more than one line", w,
                            c->name);
    }
    for (size_t k = 0; k < d->column_count; k++) {
        bool twice = strcmp(d->columns[k].name, d->scale) == 0;
        for (size_t i = 0; i < k; i++) twice = twice || strcmp(d->columns[k].name, d->columns[i].name) == 0;
        if (!twice) continue;
        fail(err, MOTUS_ARGUMENT, "two columns of the archive are named %s", d->columns[k].name);
        hint(err, "record it once, or rename it in the model");
        return MOTUS_ARGUMENT;
    }
    for (size_t k = 0; k < d->note_count; k++)
        if (!one_line(d->notes[k].name) || !d->notes[k].text)
            return fail(err, MOTUS_ARGUMENT, "note %zu of an archive has no name or no text", k);
    for (size_t k = 0; k < d->link_count; k++)
        if (!one_line(d->links[k].path) ||
            (d->links[k].column >= d->column_count && d->links[k].column != MOTUS_ARCHIVE_SCALE))
            return fail(err, MOTUS_ARGUMENT, "link %zu of an archive has no path or no column", k);
    for (size_t k = 0; k < d->attribute_count; k++)
        if (!one_line(d->attributes[k].group) || !one_line(d->attributes[k].name) ||
            (!d->attributes[k].text && lacks(d->attributes[k].numbers, 1)))
            return fail(err, MOTUS_ARGUMENT, "attribute %zu of an archive has no group, no name or no value", k);
    if (d->from && !same_shape(d))
        return fail(err, MOTUS_ARGUMENT, "the archive that is to be compressed has another definition");
    if (d->slot > INT32_MAX / 2) return fail(err, MOTUS_LIMIT, "a slot of an archive has at most 1 GiB");
    return MOTUS_OK;
}

static make_archive *maker(void)
{
    make_archive *make = NULL;
    void *const found = module_find(MAKE_FUNCTION);
    memcpy(&make, &found, sizeof make); /* POSIX lets a function be found so */
    return make;
}

int motus_archive_makes(void) { return maker() != NULL; }

/* Compresses an archive, with all notes that it has, those of other versions of motus too. */
static motus_status make_from(make_archive *make, const char *path, const motus_archive_def *d, motus_error *err)
{
    motus_archive_def own = *d;
    motus_archive_note note;
    size_t count = 0;
    while (motus_archive_note_at(d->from, count, &note)) count++;
    motus_archive_note *notes = calloc(count + 1, sizeof *notes);
    if (!notes) return fail(err, MOTUS_MEMORY, "no memory to make %s", path);
    for (size_t k = 0; k < count; k++) motus_archive_note_at(d->from, k, notes + k);
    own.notes = notes, own.note_count = count;
    const motus_status status = make(path, &own, err);
    free(notes);
    return status;
}

motus_status motus_archive_create(const char *path, const motus_archive_def *d, motus_error *err)
{
    if (!path || !d) return fail(err, MOTUS_ARGUMENT, "motus_archive_create needs a path and a definition");
    motus_status status = check(d, err);
    if (status) return status;
    make_archive *const make = maker();
    if (make && d->from) return make_from(make, path, d, err);
    if (make) return make(path, d, err);
    const char *why = dlerror();
    fail(err, MOTUS_UNAVAILABLE, "%s: this motus cannot make archives, since it was built or runs without HDF5: %.200s",
         path, why ? why : MAKE_MODULE);
    hint(err, "write .npy or CSV; or install HDF5, and build motus where libhdf5-dev is installed");
    return MOTUS_UNAVAILABLE;
}
