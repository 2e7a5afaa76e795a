/* The complete rows in the file of an interrupted sweep, up to the first row that is incomplete.
 *
 * Invariant: a file with another fingerprint, or that is not from a sweep, is an error and remains unchanged. A row
 * counts only if its bytes match their check.
 */
#include "base/decimal.h"
#include "cli/files/file.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { CHUNK = 1 << 20 };

static ssize_t read_at(const sweep_file *f, char *out, size_t count, uint64_t place, motus_error *err)
{
    const ssize_t got = file_read_at(f->descriptor, out, count, place);
    if (got < 0) file_cannot("read", f->path, errno, err);
    return got;
}

static motus_status another(const sweep_file *f, const char *command, motus_error *err)
{
    fail(err, MOTUS_STATE, command ? "%s was made by another sweep" : "%s is not the beginning of a sweep", f->path);
    if (command)
        hint(err, "it was made by: %.300s", command);
    else
        hint(err, "--force replaces it");
    return MOTUS_STATE;
}

/* ---- CSV ---- */

/* Finds the length of the head, or 0 if the file ends within it. The first line may differ, for example by another path
 * to the model: the fingerprint decides. */
static motus_status csv_head(const sweep_file *f, uint64_t end, size_t *length, motus_error *err)
{
    const sweep *s = f->sweep;
    size_t room = s->head_length + 65536; /* a longer path may lead to the model */
    char *text = malloc(room + 1);
    if (!text) return complain_memory(err);
    ssize_t got = read_at(f, text, room, 0, err);
    motus_status status = got < 0 ? MOTUS_FILE : MOTUS_OK;
    *length = 0;
    char ours[SWEEP_IDENTITY];
    if (!status && (size_t)got >= s->head_length && memcmp(text, s->head, s->head_length) == 0)
        *length = s->head_length;
    else if (!status && (uint64_t)got == end && (size_t)got < s->head_length && memcmp(text, s->head, (size_t)got) == 0)
        *length = 0;
    else if (!status) {
        text[got] = 0;
        /* "# command\n# motus …\nnames\n" */
        char *second = strchr(text, '\n'), *names = second ? strchr(second + 1, '\n') : NULL,
             *last = names ? strchr(names + 1, '\n') : NULL;
        if (strncmp(text, "# motus sweep ", 14) != 0 || !last)
            status = another(f, NULL, err);
        else if (strncmp(second + 1, sweep_head_identity(s, "", ours), (size_t)(names - second)) != 0) {
            *second = 0;
            status = another(f, text + 2, err);
        } else {
            *length = (size_t)(last + 1 - text);
        }
    }
    free(text);
    return status;
}

/* A row while it is read. */
typedef struct scan {
    char number[DECIMAL_MAX]; /* the index with which the row must begin */
    size_t at, commas;        /* the bytes and the commas that were read */
    size_t last, ended;       /* the commas before stopped_by, and before `ended` */
    bool good, stopped;
    char word[16], event[MOTUS_NAME_MAX]; /* stopped_by and `ended` */
    size_t letters;                       /* of the present word */
} scan;

static void scan_row(scan *r, uint64_t number, const sweep *s)
{
    *r = (scan){.good = true, .last = s->columns - 1, .ended = sweep_ended(s)};
    decimal_write_whole(number, r->number);
}

static const bool in_numbers[256] = {
    ['0'] = true, ['1'] = true, ['2'] = true, ['3'] = true, ['4'] = true, ['5'] = true,
    ['6'] = true, ['7'] = true, ['8'] = true, ['9'] = true, ['+'] = true, ['-'] = true,
    ['.'] = true, ['e'] = true, ['n'] = true, ['a'] = true, ['i'] = true, ['f'] = true,
};

static void scan_letter(scan *r, char *word, size_t room, char c)
{
    r->good = r->good && r->letters + 1 < room;
    if (r->good) word[r->letters++] = c;
}

static void scan_byte(scan *r, char c)
{
    if (r->commas == 0)
        r->good = r->good && c == (r->number[r->at] ? r->number[r->at] : ',');
    else if (c == ',')
        r->letters = 0;
    else if (r->commas == r->ended)
        scan_letter(r, r->event, sizeof r->event, c);
    else if (r->commas < r->last)
        r->good = r->good && in_numbers[(unsigned char)c];
    else
        scan_letter(r, r->word, sizeof r->word, c);
    r->stopped = r->stopped || (r->commas + 1 == r->last && c != ',');
    r->at++;
    r->commas += c == ',';
}

/* Returns the cause at the end of the row; MOTUS_CAUSE_COUNT: the word is not a cause. */
static int scan_cause(const scan *r)
{
    int k = 0;
    while (k < MOTUS_CAUSE_COUNT && strcmp(motus_cause_word((motus_cause)k), r->word) != 0) k++;
    return k;
}

/* Finds the complete rows before the byte `end`. */
static motus_status csv_rows(sweep_file *f, uint64_t end, motus_error *err)
{
    char *chunk = malloc(CHUNK);
    if (!chunk) return complain_memory(err);
    motus_status status = MOTUS_OK;
    uint64_t place = f->bytes;
    scan row;
    const sweep *const s = f->sweep;
    scan_row(&row, shard_trajectory(&s->shard, 0), s);
    for (ssize_t got = 1; !status && got > 0 && row.good && f->rows < s->rows;) {
        got = read_at(f, chunk, end - place < CHUNK ? (size_t)(end - place) : CHUNK, place, err);
        status = got < 0 ? MOTUS_FILE : MOTUS_OK;
        for (ssize_t i = 0; i < got && row.good && f->rows < s->rows; i++) {
            place++;
            if (chunk[i] != '\n') {
                scan_byte(&row, chunk[i]);
                continue;
            }
            const int cause = scan_cause(&row);
            row.good = row.good && row.commas == row.last && cause < MOTUS_CAUSE_COUNT &&
                       sweep_event_number(s, row.event) >= 0;
            if (!row.good) break;
            f->stopped += row.stopped;
            f->stopped_by[cause]++;
            f->bytes = place;
            scan_row(&row, shard_trajectory(&s->shard, ++f->rows), s);
        }
    }
    free(chunk);
    return status;
}

/* ---- .npy ---- */

/* Checks the fingerprint in the .json beside a .npy. */
static motus_status npy_beside(const sweep_file *f, motus_error *err)
{
    char *path = target_beside(f->path), *text = NULL, key[128], part[SHARD_TITLE];
    if (!path) return complain_memory(err);
    size_t length;
    motus_status status = file_read(path, FILE_STATE_MAX, &text, &length, err);
    if (status) hint(err, "it identifies the sweep of %s; --force starts again", f->path);
    free(path);
    const bool whole = shard_whole(&f->sweep->shard);
    snprintf(key, sizeof key, "\"fingerprint\": \"%s\", \"%s%s\"", f->sweep->fingerprint,
             whole ? "columns" : "shard\": \"", whole ? "" : shard_title(&f->sweep->shard, part));
    if (!status && !strstr(text, key)) {
        char *command = strstr(text, "\"command\": \""),
             *end = command ? strstr(command, "\", \"trajectories\"") : NULL;
        if (end) *end = 0;
        status = another(f, end ? command + 12 : NULL, err);
    }
    free(text);
    return status;
}

/* Counts the trajectories that stopped, by their causes: the last two numbers of a row are the time, NaN if the
 * trajectory did not stop, and the cause. */
static motus_status npy_stopped(sweep_file *f, uint64_t rows, uint64_t width, motus_error *err)
{
    size_t at_once = width < CHUNK ? CHUNK / width : 1;
    char *chunk = malloc(at_once * width);
    if (!chunk) return complain_memory(err);
    motus_status status = MOTUS_OK;
    while (!status && f->rows < rows) {
        size_t count = rows - f->rows < at_once ? (size_t)(rows - f->rows) : at_once;
        if (read_at(f, chunk, count * width, SWEEP_NPY_HEAD + f->rows * width, err) != (ssize_t)(count * width))
            status = MOTUS_FILE;
        for (size_t i = 0; !status && i < count; i++) {
            double ends[2];
            memcpy(ends, chunk + (i + 1) * width - sizeof ends, sizeof ends);
            f->stopped += !isnan(ends[0]);
            if (ends[1] >= 0 && ends[1] < MOTUS_CAUSE_COUNT) f->stopped_by[(int)ends[1]]++;
        }
        f->rows += count;
    }
    free(chunk);
    return status;
}

/* Reduces *end, the length of the file, to where its bytes match their checks. A file without rows needs no checks. */
static motus_status find_checks(sweep_file *f, uint64_t head, uint64_t *end, motus_error *err)
{
    const motus_status status = checks_find(&f->checks, f->path, f->descriptor, f->npy ? head : 0, err);
    if (status) return status;
    if (f->checks.missing && *end > head) return checks_refuse(&f->checks, f->path, err);
    *end = f->checks.missing ? head : f->checks.end;
    return MOTUS_OK;
}

static motus_status npy_rows(sweep_file *f, uint64_t end, motus_error *err)
{
    char head[SWEEP_NPY_HEAD + 1] = "", ours[SWEEP_NPY_HEAD];
    motus_status status = npy_beside(f, err);
    if (status) return status;
    if (end < SWEEP_NPY_HEAD) return MOTUS_OK;
    if (read_at(f, head, SWEEP_NPY_HEAD, 0, err) < 0) return MOTUS_FILE;
    sweep_npy_head(0, f->sweep->columns, ours);
    const char *shape = memchr(ours, '(', sizeof ours);
    uint64_t rows = 0;
    decimal_read_whole(head + (shape + 1 - ours), SWEEP_NPY_HEAD, &rows); /* ends at the comma */
    sweep_npy_head(rows, f->sweep->columns, ours);
    if (memcmp(head, ours, sizeof ours) != 0) return another(f, NULL, err);
    status = find_checks(f, SWEEP_NPY_HEAD, &end, err);
    if (status) return status;
    uint64_t width = f->sweep->columns * sizeof(double), there = (end - SWEEP_NPY_HEAD) / width;
    if (rows > there) rows = there;
    if (rows > f->sweep->rows) rows = f->sweep->rows;
    f->bytes = SWEEP_NPY_HEAD + rows * width;
    return npy_stopped(f, rows, width, err);
}

motus_status sweep_resume(sweep_file *f, uint64_t end, motus_error *err)
{
    f->rows = f->bytes = f->stopped = 0;
    memset(f->stopped_by, 0, sizeof f->stopped_by);
    if (f->npy) return npy_rows(f, end, err);
    size_t length = 0;
    motus_status status = csv_head(f, end, &length, err);
    if (status || length == 0) return status;
    status = find_checks(f, length, &end, err);
    f->bytes = length;
    return status || end <= length ? status : csv_rows(f, end, err);
}
