/* Reads the directory of an archive. See directory.h.
 *
 * Invariant: whatever the bytes, reading ends with a directory all of whose places lie inside the file, or with an
 * error.
 */
#include "archive/directory.h"
#include "base/error.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct reader {
    directory *d;
    const char *path;
    char *at, *end;
    uint64_t file_size;
    size_t words;
    motus_error *err;
} reader;

static motus_status damaged(const reader *r, const char *what)
{
    fail(r->err, MOTUS_STATE, "%s is damaged: %s in its directory", r->path, what);
    hint(r->err, "compute it again, or take a copy; the numbers may still be read by h5dump");
    return MOTUS_STATE;
}

/* Returns the next line without its newline; NULL: there is none. */
static char *line(reader *r)
{
    char *const begin = r->at, *const end = begin < r->end ? memchr(begin, '\n', (size_t)(r->end - begin)) : NULL;
    if (!end) return NULL;
    *end = 0;
    r->at = end + 1;
    return begin;
}

/* Tells whether the line begins with the word and a space, and moves *text behind them. */
static bool begins(char **text, const char *word)
{
    const size_t length = strlen(word);
    if (strncmp(*text, word, length) != 0 || (*text)[length] != ' ') return false;
    *text += length + 1;
    return true;
}

/* Reads decimal digits and, where more follows, the space after them. */
static bool number(char **text, uint64_t *value)
{
    char *at = *text;
    uint64_t n = 0;
    for (; *at >= '0' && *at <= '9'; at++) {
        if (n > (UINT64_MAX - 9) / 10) return false;
        n = 10 * n + (uint64_t)(*at - '0');
    }
    if (at == *text || (*at != 0 && *at != ' ')) return false;
    *text = *at ? at + 1 : at;
    *value = n;
    return true;
}

/* Tells whether `count` numbers of `width` bytes from `place` on lie in the file, after the directory. */
static bool inside(const reader *r, uint64_t place, uint64_t count, uint64_t width)
{
    return count == 0 || (place >= r->d->size && place <= r->file_size && count <= (r->file_size - place) / width);
}

/* Reads "[3]" or "[100x3]" after the kind of a column, and the space after it. */
static bool shape(char **text, size_t out[2])
{
    uint64_t n[2] = {0, 0};
    char *at = *text + 1, *end = strchr(at, ']');
    if (!end || end[1] != ' ') return false;
    *end = 0;
    char *times = strchr(at, 'x');
    if (times) *times = ' ';
    if (!number(&at, &n[0]) || (times && (!number(&at, &n[1]) || n[1] == 0)) || *at || n[0] == 0) return false;
    if (n[0] > SIZE_MAX / 16 || n[1] > SIZE_MAX / 16 / n[0]) return false;
    out[0] = (size_t)n[0], out[1] = (size_t)n[1];
    *text = end + 2;
    return true;
}

static bool column(reader *r, char *text)
{
    static const char several[] = "number[";
    directory *d = r->d;
    directory_column *c = d->columns + d->column_count;
    c->kind = MOTUS_ARCHIVE_NUMBER;
    c->shape[0] = c->shape[1] = 0;
    if (begins(&text, directory_kinds[MOTUS_ARCHIVE_WORD])) {
        c->kind = MOTUS_ARCHIVE_WORD;
    } else if (strncmp(text, several, sizeof several - 1) == 0) {
        text += sizeof several - 2;
        if (!shape(&text, c->shape)) return false;
    } else if (!begins(&text, directory_kinds[MOTUS_ARCHIVE_NUMBER])) {
        return false;
    }
    const motus_archive_column as = {.shape = {c->shape[0], c->shape[1]}};
    c->width = directory_width(c->kind) * motus_archive_width(&as);
    if (!number(&text, &c->place) || !*text) return false;
    if (!d->packed_place && !inside(r, c->place, d->rows, c->width)) return false;
    c->name = text;
    c->comment = NULL;
    c->words = d->words + r->words;
    c->word_count = 0;
    d->column_count++;
    return true;
}

static bool slots(reader *r, char *text)
{
    directory *d = r->d;
    if (d->slot || !number(&text, &d->slots_place) || !number(&text, &d->slot) || *text) return false;
    return d->slot > 0 && d->slot <= SIZE_MAX / 4 && inside(r, d->slots_place, 2, d->slot);
}

static bool comment(reader *r, const char *text)
{
    directory *d = r->d;
    directory_column *c = d->column_count ? d->columns + d->column_count - 1 : NULL;
    if (!c || c->comment || !*text) return false;
    c->comment = text;
    return true;
}

static bool word(reader *r, const char *text)
{
    directory *d = r->d;
    directory_column *c = d->column_count ? d->columns + d->column_count - 1 : NULL;
    if (!c || c->kind != MOTUS_ARCHIVE_WORD || c->word_count == 255) return false;
    d->words[r->words++] = text;
    c->word_count++;
    return true;
}

static bool note(reader *r, char *text)
{
    uint64_t length;
    directory *d = r->d;
    if (!number(&text, &length) || !*text || length >= (uint64_t)(r->end - r->at) || r->at[length] != '\n')
        return false;
    r->at[length] = 0;
    d->notes[d->note_count++] = (motus_archive_note){text, r->at};
    r->at += length + 1;
    return strlen(d->notes[d->note_count - 1].text) == length;
}

/* Reads the lines before the columns, in their order. */
static bool measures(reader *r)
{
    directory *d = r->d;
    char *text = line(r);
    if (!text || !begins(&text, "rows") || !number(&text, &d->rows) || *text) return false;
    text = line(r);
    if (!text || !begins(&text, "block") || !number(&text, &d->block) || *text) return false;
    if (d->block == 0 || d->block > SIZE_MAX / sizeof(double)) return false;
    text = line(r);
    if (!text || !begins(&text, "number") || !number(&text, &d->number_place) || !*text) return false;
    text = line(r);
    if (!text || !begins(&text, "done") || !number(&text, &d->done_place) || *text) return false;
    if (!inside(r, d->done_place, directory_blocks(d->rows, d->block), sizeof(uint64_t))) return false;
    char *const next = r->at;
    text = line(r);
    if (text && begins(&text, "packed")) return number(&text, &d->packed_place) && !*text && d->packed_place > 0;
    if (text) r->at[-1] = '\n';
    r->at = next;
    return inside(r, d->number_place, d->rows, sizeof(int64_t));
}

/* A compressed block is at most this many times as large as its bytes in the file (zlib's limit is 1032). */
enum { SHRINKS = 1100 };

/* Tells whether the pieces lie in the file, and are long enough for a block of their column. */
static bool pieces(const reader *r)
{
    const directory *d = r->d;
    const uint64_t most = d->rows < d->block ? d->rows : d->block, room = r->file_size * SHRINKS;
    if (!d->packed_place) return true;
    for (size_t k = 0; k < d->column_count; k++)
        if (most > room / d->columns[k].width) return false;
    const uint64_t blocks = directory_blocks(d->rows, d->block);
    return most <= room / sizeof(int64_t) &&
           inside(r, d->packed_place, blocks, (d->column_count + 1) * sizeof(directory_piece));
}

/* Takes room for as many columns, words and notes as there are lines. */
static bool make_room(reader *r)
{
    size_t lines = 1;
    for (const char *at = r->at; at < r->end; at++) lines += *at == '\n';
    directory *d = r->d;
    d->columns = calloc(lines, sizeof *d->columns);
    d->notes = calloc(lines, sizeof *d->notes);
    d->words = calloc(lines, sizeof *d->words);
    return d->columns && d->notes && d->words;
}

static motus_status body(reader *r)
{
    if (!make_room(r)) return fail(r->err, MOTUS_MEMORY, "no memory for the directory of %s", r->path);
    if (!measures(r)) return damaged(r, "the number of rows is wrong");
    for (;;) {
        char *text = line(r);
        if (!text) return damaged(r, "the end is missing");
        if (strcmp(text, "end") == 0) break;
        if (!(begins(&text, "column")    ? column(r, text)
              : begins(&text, "word")    ? word(r, text)
              : begins(&text, "comment") ? comment(r, text)
              : begins(&text, "note")    ? note(r, text)
              : begins(&text, "slots")   ? slots(r, text)
                                         : false))
            return damaged(r, "a line is wrong");
    }
    if (!r->d->column_count) return damaged(r, "the columns are missing");
    return pieces(r) ? MOTUS_OK : damaged(r, "the number of rows is wrong");
}

static motus_status foreign(const char *path, motus_error *err)
{
    fail(err, MOTUS_STATE, "%s is not an archive of motus", path);
    hint(err, "archives are the files that motus sweep and motus run write, -o FILE.h5");
    return MOTUS_STATE;
}

motus_status directory_read(directory *d, const char *bytes, size_t count, uint64_t file_size, const char *path,
                            size_t *size, motus_error *err)
{
    char head[DIRECTORY_HEAD + 1] = "", *text = head;
    uint64_t format, all;
    const size_t first = count < DIRECTORY_HEAD ? count : DIRECTORY_HEAD;
    *d = (directory){0};
    memcpy(head, bytes, first);
    if (count == 0) {
        fail(err, MOTUS_STATE, "%s is empty: what makes it was interrupted, or has not begun", path);
        hint(err, "its command with --resume makes it");
        return MOTUS_STATE;
    }
    if (!begins(&text, "motus") || !begins(&text, "archive")) return foreign(path, err);
    char *end = strchr(text, '\n'), *hash_end;
    if (!end) return foreign(path, err);
    *end = 0;
    if (!number(&text, &format) || format == 0) return foreign(path, err);
    if (format > MOTUS_ARCHIVE_FORMAT) {
        fail(err, MOTUS_UNAVAILABLE, "%s has version %" PRIu64 " of the archives, and motus %s reads up to version %d",
             path, format, MOTUS_VERSION, MOTUS_ARCHIVE_FORMAT);
        hint(err, "take a later version of motus; the numbers may be read by h5py or h5dump");
        return MOTUS_UNAVAILABLE;
    }
    text = end + 1;
    reader r = {.d = d, .path = path, .file_size = file_size, .err = err};
    end = strchr(text, '\n');
    if (!end) return damaged(&r, "the second line is missing");
    *end = 0;
    if (!begins(&text, "directory") || !number(&text, &all) || all < DIRECTORY_LEAST || all > DIRECTORY_MOST ||
        strlen(text) != 16)
        return damaged(&r, "the second line is wrong");
    const uint64_t hash = strtoull(text, &hash_end, 16);
    if (*hash_end) return damaged(&r, "the second line is wrong");
    if (all > file_size) {
        fail(err, MOTUS_STATE, "%s is truncated: it ends within its directory", path);
        hint(err, "copy it again, or compute it again");
        return MOTUS_STATE;
    }
    *size = d->size = (size_t)all;
    if (d->size > count) return fail(err, MOTUS_LIMIT, "the directory is larger");
    if (!(d->text = malloc(d->size + 1))) return fail(err, MOTUS_MEMORY, "no memory for the directory of %s", path);
    memcpy(d->text, bytes, d->size);
    d->text[d->size] = 0;
    r.at = d->text + (end + 1 - head);
    r.end = r.at + strlen(r.at);
    if (directory_hash(DIRECTORY_HASH, r.at, (size_t)(r.end - r.at)) != hash) return damaged(&r, "a byte is wrong");
    return body(&r);
}

void directory_free(directory *d)
{
    free(d->text);
    free(d->columns);
    free(d->notes);
    free(d->words);
    *d = (directory){0};
}
