/* The file of one shard. See part.h.
 *
 * Invariant: a row is copied only if its trajectory is the next one, and if it matches its check, should the file have
 * checks. So the merged file has the rows of all trajectories in their order. A file is open only while one of its
 * blocks is copied, since there may be more shards than a process may have open files.
 */
#include "cli/sweep/part.h"

#include "base/decimal.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"

#include <errno.h>
#include <inttypes.h>
#include <motus-archive.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>

static motus_status no_shard(const part *p, const char *what, motus_error *err)
{
    return complain(err, MOTUS_STATE, "motus merge joins the files that motus sweep --shard K/N writes", "%s %s",
                    p->path, what);
}

motus_status part_unfinished(const part *p, motus_error *err)
{
    char text[SHARD_TEXT];
    return complain(err, MOTUS_STATE, "its command with --resume completes it",
                    "%s ends before its last trajectory: shard %s was interrupted", p->path,
                    shard_text(&p->shard, text));
}

static motus_status damaged(const part *p, uint64_t trajectory, motus_error *err)
{
    return complain(err, MOTUS_STATE, "compute this shard again: its command with --force",
                    "%s is damaged: the row of trajectory %" PRIu64 " is not where it must be", p->path, trajectory);
}

static motus_status empty(const part *p, motus_error *err)
{
    return complain(err, MOTUS_STATE, "its command with --resume completes it",
                    "%s is empty: its sweep was interrupted, or not begun", p->path);
}

/* ---- heads ---- */

/* Removes the last `what` before `end`. Returns false if there is none. */
static bool cut(char *text, const char *end, const char *what)
{
    const size_t length = strlen(what);
    char *last = NULL;
    for (char *at = strstr(text, what); at && at + length <= end; at = strstr(at + 1, what)) last = at;
    if (last) memmove(last, last + length, strlen(last + length) + 1);
    return last;
}

/* Reads the shard and the number of trajectories after these words, and removes the shard from the head, which becomes
 * that of the whole sweep. Returns false if the head does not have them. */
static bool take_shard(part *p, const char *its, const char *trajectories, const char *before, const char *after)
{
    char words[96], text[SHARD_TEXT], title[SHARD_TITLE];
    const char *count = strstr(its, trajectories), *mark = strstr(its, before);
    if (!count || !mark) return false;
    count += strlen(trajectories);
    if (!decimal_read_whole(count, strlen(count), &p->total) || p->total == 0 || p->total > GRID_MOST) return false;
    const size_t length = shard_parse(&p->shard, mark + strlen(before));
    if (length == 0 || length >= SHARD_TITLE || p->shard.count < 2 || p->shard.count > SHARD_MOST) return false;
    shard_text(&p->shard, text);
    snprintf(words, sizeof words, " --shard %s", text);
    const size_t from = (size_t)(its - p->head);
    if (!cut(p->head, p->head + from, words)) return false;
    p->its = p->head + from - strlen(words);
    snprintf(words, sizeof words, "%s%s%s", before, shard_title(&p->shard, title), after);
    return cut(p->head, p->head + strlen(p->head), words);
}

/* Reads "# motus sweep …\n# motus VERSION, trajectories N, fingerprint F, shard K/N\nnames\n". */
static motus_status csv_head(part *p, FILE *in, motus_error *err)
{
    size_t room = 0, used = 0;
    char *line = NULL;
    ssize_t length = 0;
    size_t ends[3] = {0};
    motus_status status = MOTUS_OK;
    for (int k = 0; !status && k < 3; k++) {
        length = getline(&line, &room, in);
        if (length <= 0 || line[length - 1] != '\n' || strlen(line) != (size_t)length) break;
        char *more = realloc(p->head, used + (size_t)length + 1);
        if (!more) {
            status = complain_memory(err);
            break;
        }
        p->head = more;
        memcpy(p->head + used, line, (size_t)length + 1);
        ends[k] = used += (size_t)length;
    }
    free(line);
    if (status) return status;
    if (ferror(in)) return file_cannot("read", p->path, errno, err);
    static const char first[] = "# motus sweep ";
    if (!p->head || strncmp(p->head, first, sizeof first - 1) != 0)
        return no_shard(p, "is not the table of a sweep", err);
    if (!ends[2]) return part_unfinished(p, err);
    p->at = used;
    const char *its = p->head + ends[0], *events = strstr(its, ", events of trajectories ");
    p->kind = events && events < p->head + ends[1] ? PART_EVENTS : PART_ROWS;
    return take_shard(p, its, "trajectories ", ", shard ", "") ? MOTUS_OK
                                                               : no_shard(p, "is a whole sweep, not a shard", err);
}

static motus_status npy_head(part *p, FILE *in, motus_error *err)
{
    char ours[SWEEP_NPY_HEAD], theirs[SWEEP_NPY_HEAD + 1] = "";
    p->kind = PART_NPY;
    if (fread(theirs, 1, SWEEP_NPY_HEAD, in) != SWEEP_NPY_HEAD) return part_unfinished(p, err);
    uint64_t rows = 0, columns = 0;
    const char *shape = strchr(theirs + 10, '('), *comma = shape ? strchr(shape, ',') : NULL;
    if (comma) {
        decimal_read_whole(shape + 1, strlen(shape + 1), &rows);
        decimal_read_whole(comma + 2, strlen(comma + 2), &columns);
    }
    if (columns == 0 || columns > SIZE_MAX / sizeof(double)) return no_shard(p, "is not the .npy of a sweep", err);
    sweep_npy_head(rows, (size_t)columns, ours);
    if (memcmp(ours, theirs, sizeof ours) != 0) return no_shard(p, "is not the .npy of a sweep", err);
    p->width = (size_t)columns * sizeof(double);
    p->at = SWEEP_NPY_HEAD;
    char *beside = target_beside(p->path);
    if (!beside) return complain_memory(err);
    size_t length;
    motus_status status = file_read(beside, FILE_MODEL_MAX, &p->head, &length, err);
    free(beside);
    if (status) {
        hint(err, "it says which shard of which sweep %s is", p->path);
        return status;
    }
    const char *its = strstr(p->head, "\", \"trajectories\": ");
    if (strlen(p->head) != length || !its || !take_shard(p, its, "\"trajectories\": ", "\"shard\": \"", "\", "))
        return no_shard(p, "is not a shard, according to the .json beside it", err);
    return rows == shard_rows(&p->shard, p->total) ? MOTUS_OK : part_unfinished(p, err);
}

/* Returns what all shards of a sweep share: the fingerprint and the columns. The caller frees it. NULL: no memory. */
static char *common(const motus_archive *a)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    motus_archive_column c;
    if (!out) return NULL;
    fprintf(out, "%s\n", motus_archive_note_of(a, "fingerprint"));
    for (size_t k = 0; motus_archive_column_at(a, k, &c); k++) fprintf(out, "%d %s\n", (int)c.kind, c.name);
    return fclose(out) == 0 ? text : NULL;
}

/* Returns whether an archive has the rows of the shard that it names. */
static bool fits(const motus_archive *a, const part *p)
{
    return archived_sweep(a) && motus_archive_rows(a) == shard_rows(&p->shard, p->total);
}

static motus_status archive_head(part *p, motus_error *err)
{
    motus_archive *a;
    p->kind = PART_ARCHIVE;
    motus_status status = motus_archive_open(p->path, 0, &a, err);
    if (status) return status;
    const char *total = motus_archive_note_of(a, "trajectories"), *share = motus_archive_note_of(a, "shard");
    if (!share)
        status = no_shard(p, "is a whole sweep, not a shard", err);
    else if (!total || !motus_archive_note_of(a, "fingerprint") || !motus_archive_note_of(a, "command") ||
             !decimal_read_whole(total, strlen(total), &p->total) || p->total == 0 || p->total > GRID_MOST ||
             shard_parse(&p->shard, share) != strlen(share) ||
             (p->shard.block = motus_archive_block_rows(a)) > SHARD_BLOCK || p->shard.count < 2 ||
             p->shard.count > SHARD_MOST || !fits(a, p))
        status = no_shard(p, "is not a shard of a sweep, according to its notes", err);
    p->head = status ? NULL : common(a);
    if (!status && !p->head) status = complain_memory(err);
    p->its = p->head;
    motus_archive_close(a);
    return status;
}

static FILE *open_at(const part *p)
{
    FILE *in = fopen(p->path, "rbe");
    if (in && p->at > 0 && fseeko(in, (off_t)p->at, SEEK_SET) != 0) {
        const int code = errno;
        fclose(in);
        errno = code;
        return NULL;
    }
    return in;
}

/* Finds up to where the bytes of a part match their checks. */
static motus_status find_checks(part *p, FILE *in, motus_error *err)
{
    checks c = {.descriptor = -1};
    const motus_status status = checks_find(&c, p->path, fileno(in), p->kind == PART_NPY ? p->at : 0, err);
    p->checked = c.missing ? UINT64_MAX : c.end;
    p->broken = c.broken;
    checks_close(&c);
    return status;
}

motus_status part_open(part *p, const char *path, motus_error *err)
{
    *p = (part){.path = path};
    struct stat about; /* a pipe could not be opened again for each block */
    if (stat(path, &about) == 0 && !S_ISREG(about.st_mode)) return no_shard(p, "is not a regular file", err);
    FILE *in = open_at(p);
    if (!in) return file_cannot("read", path, errno, err);
    motus_status status = MOTUS_OK;
    if (target_busy(path, fileno(in))) {
        status = fail(err, MOTUS_STATE, "%s is being written by another program", path);
        hint(err, "wait until its sweep has ended");
    }
    const int magic = status ? EOF : getc(in);
    if (magic != EOF) ungetc(magic, in);
    if (!status && magic == EOF) status = empty(p, err);
    if (!status && magic == 0) status = no_shard(p, "is not a shard of a sweep", err);
    if (!status)
        status = magic == 0x93 ? npy_head(p, in, err) : magic == 'm' ? archive_head(p, err) : csv_head(p, in, err);
    if (!status && p->kind != PART_ARCHIVE) status = find_checks(p, in, err);
    fclose(in);
    return status;
}

void part_close(part *p)
{
    free(p->head);
    *p = (part){0};
}

/* ---- rows ---- */

/* Returns whether a line begins with this number and a comma. */
static bool begins_with(const char *line, uint64_t number)
{
    char text[DECIMAL_MAX + 1];
    const size_t length = decimal_write_whole(number, text);
    return strncmp(line, text, length) == 0 && line[length] == ',';
}

static motus_status copy_lines(part *p, FILE *in, uint64_t first, uint64_t count, file_out *out, motus_error *err)
{
    const bool events = p->kind == PART_EVENTS;
    char *line = NULL;
    size_t room = 0;
    motus_status status = MOTUS_OK;
    for (uint64_t next = first, behind = first + count; !status && (events || next < behind);) {
        const ssize_t length = getline(&line, &room, in);
        if (length <= 0 || line[length - 1] != '\n') {
            status = ferror(in) ? file_cannot("read", p->path, errno, err) : part_unfinished(p, err);
            break;
        }
        if (events) { /* a trajectory has any number of events */
            uint64_t number = UINT64_MAX;
            if (line[0] != '#' && !decimal_read_whole(line, (size_t)length, &number)) number = 0;
            if (number >= behind) break;
            if (number < next || !begins_with(line, number)) status = damaged(p, next, err);
            next = number;
        } else {
            if (!begins_with(line, next)) status = damaged(p, next, err);
            next++;
        }
        if (!status) status = file_write(out, line, (size_t)length, err);
        p->at += (uint64_t)length;
    }
    free(line);
    return status;
}

static motus_status copy_numbers(part *p, FILE *in, uint64_t first, uint64_t count, file_out *out, motus_error *err)
{
    char *row = malloc(p->width);
    if (!row) return complain_memory(err);
    motus_status status = MOTUS_OK;
    for (uint64_t next = first; !status && next < first + count; next++) {
        double number;
        if (fread(row, 1, p->width, in) != p->width) {
            status = ferror(in) ? file_cannot("read", p->path, errno, err) : part_unfinished(p, err);
            break;
        }
        memcpy(&number, row, sizeof number);
        status = number == (double)next ? file_write(out, row, p->width, err) : damaged(p, next, err);
        p->at += p->width;
    }
    free(row);
    return status;
}

static motus_status not_as_written(const part *p, motus_error *err)
{
    fail(err, MOTUS_STATE, "%s is damaged: after byte %" PRIu64 ", it is not as it was written", p->path, p->checked);
    hint(err, p->kind == PART_EVENTS ? "compute this shard again: its command with --force"
                                     : "its command with --resume computes that again");
    return MOTUS_STATE;
}

motus_status part_copy(part *p, uint64_t block, file_out *out, motus_error *err)
{
    const uint64_t first = block * p->shard.block, left = p->total - first;
    const uint64_t count = left < p->shard.block ? left : p->shard.block;
    FILE *in = open_at(p);
    if (!in) return file_cannot("read", p->path, errno, err);
    const motus_status status = (p->kind == PART_NPY ? copy_numbers : copy_lines)(p, in, first, count, out, err);
    fclose(in);
    if (status || p->at <= p->checked) return status;
    return p->broken ? not_as_written(p, err) : part_unfinished(p, err);
}

motus_status part_end(part *p, motus_error *err)
{
    char rest[2 * SWEEP_EVENTS_LAST] = "", end[SWEEP_EVENTS_LAST] = "";
    if (p->kind == PART_EVENTS) snprintf(end, sizeof end, SWEEP_EVENTS_END, shard_rows(&p->shard, p->total));
    FILE *in = open_at(p);
    if (!in) return file_cannot("read", p->path, errno, err);
    const size_t got = fread(rest, 1, sizeof rest - 1, in);
    fclose(in);
    const bool ends = got == strlen(end) && memcmp(rest, end, got) == 0;
    if (ends) return p->broken ? not_as_written(p, err) : MOTUS_OK;
    if (p->kind == PART_EVENTS && (got == 0 || rest[0] == '#')) return part_unfinished(p, err);
    return complain(err, MOTUS_STATE, "compute this shard again: its command with --force",
                    "%s is damaged: it continues after its last trajectory", p->path);
}
