/* The file of a sweep's rows.
 *
 * Invariant: however the program ends, the file has its head and complete rows; only a kill or a power cut may leave an
 * incomplete last row, which --resume removes. After a failed write the file is cut after its last complete row. The
 * head of a .npy has the number of rows and is written after them. The check of a row (checks.h) is written after the
 * row; the file of checks exists before the first row.
 */
#include "base/decimal.h"
#include "base/disk.h"
#include "cli/files/file.h"
#include "cli/files/stop.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BUFFER = 1 << 20 };

motus_status sweep_file_check(const options *o, motus_error *err)
{
    const char *path = o->output ? o->output : "-";
    bool output = strcmp(path, "-") == 0;
    if (o->compress && (output || !target_archive(path)))
        return complain(err, MOTUS_ARGUMENT, "-o FILE.h5", "--compress is for archives");
    if (output && o->resume) return complain(err, MOTUS_ARGUMENT, "add -o FILE", "--resume needs a file");
    if (output && o->json)
        return complain(err, MOTUS_ARGUMENT, "write the rows to a file: -o sweep.csv",
                        "--json and the rows both go to standard output");
    return target_check(o, path, err);
}

/* Returns the number of complete rows in `count` bytes, and in *end where the last of them ends. */
static uint64_t complete_rows(const sweep_file *f, const char *bytes, size_t count, size_t *end)
{
    uint64_t rows = 0;
    size_t width = f->sweep->columns * sizeof(double);
    *end = f->npy ? count / width * width : 0;
    for (size_t i = 0; !f->npy && i < count; i++)
        if (bytes[i] == '\n') {
            rows++;
            *end = i + 1;
        }
    return f->npy ? count / width : rows;
}

static motus_status put_head_bytes(sweep_file *f, const char *bytes, size_t count, motus_error *err)
{
    size_t written;
    int code = target_bytes(f->descriptor, bytes, count, &written);
    if (code && f->regular && ftruncate(f->descriptor, 0) != 0) code = errno;
    f->bytes = code ? 0 : count;
    return code ? file_cannot_write(f->path, code, err) : MOTUS_OK;
}

static motus_status put_npy_head(sweep_file *f, motus_error *err)
{
    char head[SWEEP_NPY_HEAD];
    sweep_npy_head(f->rows, f->sweep->columns, head);
    errno = EIO;
    return pwrite(f->descriptor, head, sizeof head, 0) == (ssize_t)sizeof head ? MOTUS_OK
                                                                               : file_cannot_write(f->path, errno, err);
}

/* Writes the head of a .npy to the .json beside it, before the first row. */
static motus_status put_beside(const sweep_file *f, motus_error *err)
{
    char *path = target_beside(f->path);
    if (!path) return complain_memory(err);
    file_out out = {0};
    motus_status status = file_create(&out, path, err);
    if (!status) status = file_write(&out, f->sweep->head, f->sweep->head_length, err);
    if (!status) status = file_finish(&out, err);
    if (!status) status = file_keep(&out, err);
    file_drop(&out);
    free(path);
    return status;
}

static motus_status put_head(sweep_file *f, motus_error *err)
{
    f->rows = f->bytes = f->stopped = f->lost = 0;
    memset(f->stopped_by, 0, sizeof f->stopped_by);
    if (f->regular && (ftruncate(f->descriptor, 0) != 0 || lseek(f->descriptor, 0, SEEK_SET) != 0))
        return file_cannot_write(f->path, errno, err);
    motus_status status = MOTUS_OK;
    if (f->regular) status = checks_begin(&f->checks, f->path, f->npy ? SWEEP_NPY_HEAD : 0, false, err);
    if (!status && !f->npy) {
        status = put_head_bytes(f, f->sweep->head, f->sweep->head_length, err);
        if (!status) checks_add(&f->checks, f->sweep->head, f->sweep->head_length);
    }
    if (status || !f->npy) return status;
    status = put_beside(f, err);
    if (!status) status = put_npy_head(f, err);
    if (!status && lseek(f->descriptor, SWEEP_NPY_HEAD, SEEK_SET) < 0) return file_cannot_write(f->path, errno, err);
    f->bytes = SWEEP_NPY_HEAD;
    return status;
}

static motus_status go_on(sweep_file *f, uint64_t end, motus_error *err)
{
    motus_status status = sweep_resume(f, end, err);
    if (!status && f->checks.broken && !f->sweep->options->quiet)
        complain_note("%s is damaged: only its first %llu rows are as they were written; the others are computed again",
                      f->path, (unsigned long long)f->rows);
    if (status || f->rows == 0) return status ? status : put_head(f, err);
    f->found = f->rows;
    status = checks_go_on(&f->checks, f->descriptor, f->bytes, err);
    if (status) return status;
    if (f->bytes != end && ftruncate(f->descriptor, (off_t)f->bytes) != 0)
        return file_cannot_write(f->path, errno, err);
    if (lseek(f->descriptor, (off_t)f->bytes, SEEK_SET) < 0) return file_cannot_write(f->path, errno, err);
    return f->npy ? put_npy_head(f, err) : MOTUS_OK;
}

/* Opens an archive. A new archive replaces the file that was locked, and is then locked itself. */
static motus_status open_archive(sweep_file *f, bool found, bool made, motus_error *err)
{
    motus_status status = sweep_archive_open(f, found, err);
    if (status && made && !found) unlink(f->path); /* target_lock() has made the file */
    if (status || found) return status;
    close(f->descriptor);
    return target_lock(f->path, &f->descriptor, &f->regular, err);
}

motus_status sweep_file_open(sweep_file *f, const sweep *s, motus_error *err)
{
    const options *o = s->options;
    *f = (sweep_file){.sweep = s, .path = o->output ? o->output : "-", .descriptor = -1, .events = f->events};
    f->npy = target_npy(f->path);
    f->room = s->columns < SIZE_MAX / 64 - BUFFER ? BUFFER + s->columns * DECIMAL_MAX + MOTUS_NAME_MAX : 0;
    f->buffer = f->room ? malloc(f->room) : NULL;
    f->numbers = malloc(s->columns * sizeof *f->numbers);
    if (!f->buffer || !f->numbers) return complain_memory(err);
    if (!team_first(o->team)) return sweep_archive_open(f, true, err); /* rank 0 has made and locked it */
    if (strcmp(f->path, "-") == 0) {
        f->descriptor = STDOUT_FILENO;
        return put_head(f, err);
    }
    const bool made = access(f->path, F_OK) != 0;
    motus_status status = target_lock(f->path, &f->descriptor, &f->regular, err);
    if (status || !f->regular) return status ? status : put_head(f, err);
    struct stat about; /* check again: the file may have changed before it was locked */
    status = fstat(f->descriptor, &about) == 0 ? sweep_file_check(o, err) : file_cannot_write(f->path, errno, err);
    if (status) return status;
    if (target_archive(f->path)) return open_archive(f, o->resume && about.st_size > 0, made, err);
    return o->resume && about.st_size > 0 ? go_on(f, (uint64_t)about.st_size, err) : put_head(f, err);
}

/* Writes the rows in the buffer; after a failure, the file keeps the complete ones. *rows counts those in the file. */
static motus_status flush(sweep_file *f, uint64_t *rows, motus_error *err)
{
    size_t written, end;
    int code = target_bytes(f->descriptor, f->buffer, f->used, &written);
    f->used = 0;
    if (!code) {
        *rows = f->rows;
        f->bytes += written;
        checks_add(&f->checks, f->buffer, written);
        return checks_mark(&f->checks, err);
    }
    *rows += complete_rows(f, f->buffer, written, &end);
    f->bytes += end;
    checks_add(&f->checks, f->buffer, end);
    checks_mark(&f->checks, NULL);
    if (f->regular && ftruncate(f->descriptor, (off_t)f->bytes) != 0) code = errno;
    return file_cannot_write(f->path, code, err);
}

static char *put_word(char *out, const char *word)
{
    while (*word) *out++ = *word++;
    return out;
}

static void csv_row(sweep_file *f, size_t i, const sweep_rows *rows)
{
    const sweep *s = f->sweep;
    const bool stopped = !isnan(rows->stopped[i]);
    const size_t count = s->columns - 2; /* without the number of the row, and stopped_by, a word */
    sweep_row_numbers(s, rows, i, 1, f->numbers, 0, 1);
    char *out = f->buffer + f->used;
    out += decimal_write_whole(shard_trajectory(&s->shard, f->rows), out);
    for (size_t k = 0; k < count; k++) {
        const bool last = k + 1 == count, none = k < s->grid.count ? false : last ? !stopped : stopped;
        *out++ = ',';
        if (k + 1 == sweep_ended(s)) /* column 0 is the number of the row */
            out = put_word(out, motus_ensemble_ended(s->ensemble, i));
        else if (!none)
            out += decimal_write(f->numbers[k], out);
    }
    *out++ = ',';
    out = put_word(out, motus_cause_word(motus_ensemble_stopped_by(s->ensemble, i)));
    *out++ = '\n';
    f->used = (size_t)(out - f->buffer);
}

static void npy_row(sweep_file *f, size_t i, const sweep_rows *rows)
{
    const size_t size = f->sweep->columns * sizeof *f->numbers;
    f->numbers[0] = (double)shard_trajectory(&f->sweep->shard, f->rows);
    sweep_row_numbers(f->sweep, rows, i, 1, f->numbers + 1, 0, 1);
    memcpy(f->buffer + f->used, f->numbers, size);
    f->used += size;
}

uint64_t sweep_file_left(const sweep_file *f) { return f->archive ? sweep_archive_left(f) : f->sweep->rows - f->rows; }
double sweep_file_done(const sweep_file *f) { return f->archive ? sweep_archive_done(f) : (double)f->rows; }
uint64_t sweep_file_have(const sweep_file *f) { return f->archive ? sweep_archive_have(f) : f->rows; }

motus_status sweep_file_rows(sweep_file *f, size_t count, const sweep_rows *given, motus_error *err)
{
    motus_status status = MOTUS_OK;
    uint64_t rows = f->rows; /* those in the file; f->rows also counts those in the buffer */
    for (size_t i = 0; i < count; i++) {
        f->stopped += !isnan(given->stopped[i]);
        f->lost += f->sweep->errors && isnan(given->stopped[i]) && sweep_row_lost(f->sweep, given, i);
        f->stopped_by[motus_ensemble_stopped_by(f->sweep->ensemble, i)]++;
    }
    if (f->archive) return sweep_archive_rows(f, count, given, err);
    for (size_t i = 0; !status && i < count; i++) {
        (f->npy ? npy_row : csv_row)(f, i, given);
        f->rows++;
        if (f->used >= BUFFER || i + 1 == count) status = flush(f, &rows, err);
    }
    f->rows = rows;
    if (!f->npy) return status;
    motus_status head = put_npy_head(f, status ? NULL : err);
    return status ? status : head;
}

motus_status sweep_file_finish(sweep_file *f, motus_error *err)
{
    if (f->archive) return sweep_archive_finish(f, err);
    if (f->regular && !disk_sync(f->descriptor)) return file_cannot_write(f->path, errno, err);
    const motus_status status = checks_finish(&f->checks, err);
    if (status) return status;
    int descriptor = f->descriptor;
    f->descriptor = -1;
    return descriptor > STDERR_FILENO && close(descriptor) != 0 ? file_cannot_write(f->path, errno, err) : MOTUS_OK;
}

void sweep_file_close(sweep_file *f)
{
    sweep_archive_close(f);
    checks_close(&f->checks);
    if (f->descriptor > STDERR_FILENO) close(f->descriptor);
    free(f->buffer);
    free(f->numbers);
    *f = (sweep_file){.descriptor = -1};
}
