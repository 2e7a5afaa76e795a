/* See checks.h. */
#include "cli/files/checks.h"

#include "base/decimal.h"
#include "base/disk.h"
#include "cli/files/command.h"
#include "cli/words/complain.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char first_line[] = "# motus checks: bytes of the file, and the hash of those since the last 16384\n";
_Static_assert(CHECKS_PIECE == 16384, "the first line says so");
enum { HEAD = sizeof first_line - 1, LINE = 20 + 1 + 16 + 1 };

static int write_at(int descriptor, const char *bytes, size_t count, uint64_t place)
{
    for (size_t done = 0; done < count;) {
        const ssize_t more = pwrite(descriptor, bytes + done, count - done, (off_t)(place + done));
        if (more < 0 && errno != EINTR) return errno;
        if (more > 0) done += (size_t)more;
    }
    return 0;
}

/* ---- lines ---- */

static uint64_t piece_of(uint64_t byte) { return byte / CHECKS_PIECE * CHECKS_PIECE; }
/* Returns where the bytes begin that the line ending at `end` has the hash of. */
static uint64_t begins(const checks *c, uint64_t end)
{
    const uint64_t piece = piece_of(end - 1);
    return piece > c->from ? piece : c->from;
}

/* Returns the hash of the piece up to c->end. */
static uint64_t hash_of(const checks *c)
{
    const uint64_t first = begins(c, c->end);
    uint64_t hash = COMMAND_HASH;
    command_mix(&hash, &first, sizeof first);
    command_mix(&hash, c->piece + first % CHECKS_PIECE, (size_t)(c->end - first));
    return hash;
}

static void put_line(checks *c)
{
    char line[LINE + 1];
    snprintf(line, sizeof line, "%020" PRIu64 " %016" PRIx64 "\n", c->end, hash_of(c));
    const int code = write_at(c->descriptor, line, LINE, HEAD + c->lines * LINE);
    if (!c->code) c->code = code;
    c->lines++;
    c->said = c->end;
}

static bool read_line(const char *line, uint64_t *end, uint64_t *hash)
{
    char again[LINE + 1];
    if (decimal_read_whole(line, 20, end) != 20 || sscanf(line + 20, " %16" SCNx64, hash) != 1) return false;
    snprintf(again, sizeof again, "%020" PRIu64 " %016" PRIx64 "\n", *end, *hash);
    return memcmp(line, again, LINE) == 0;
}

/* ---- writing ---- */

/* Returns whether a file of this name is ours, empty, or absent. */
static bool may_replace(const char *path)
{
    char theirs[HEAD] = "";
    const int in = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (in < 0) return true;
    const ssize_t got = file_read_at(in, theirs, HEAD, 0);
    close(in);
    return got == 0 || (got > 0 && memcmp(theirs, first_line, (size_t)got) == 0);
}

static motus_status name_of(checks *c, const char *file, uint64_t from, motus_error *err)
{
    checks_close(c);
    c->path = disk_beside(file, ".check");
    c->from = c->end = c->said = from;
    return c->path ? MOTUS_OK : complain_memory(err);
}

static motus_status reopen(checks *c, motus_error *err)
{
    c->descriptor = open(c->path, O_RDWR | O_CLOEXEC);
    return c->descriptor < 0 ? file_cannot("write", c->path, errno, err) : MOTUS_OK;
}

motus_status checks_begin(checks *c, const char *file, uint64_t from, bool at_once, motus_error *err)
{
    motus_status status = name_of(c, file, from, err);
    if (status) return status;
    if (!may_replace(c->path))
        return complain(err, MOTUS_ARGUMENT, "rename one of the two files",
                        "%s is another file, but the checks of %s need this name", c->path, file);
    status = file_create(&c->out, c->path, err);
    if (!status) status = file_text(&c->out, first_line, err);
    if (!status && at_once) {
        if (fflush(c->out.stream) != 0) return file_cannot("write", c->path, errno, err);
        c->descriptor = fileno(c->out.stream);
        return MOTUS_OK;
    }
    if (!status) status = file_finish(&c->out, err);
    if (!status) status = file_keep(&c->out, err);
    file_drop(&c->out);
    return status ? status : reopen(c, err);
}

void checks_add(checks *c, const void *bytes, size_t count)
{
    const unsigned char *at = bytes;
    while (c->path && count > 0) {
        const size_t within = (size_t)(c->end % CHECKS_PIECE), left = CHECKS_PIECE - within;
        const size_t some = left < count ? left : count;
        memcpy(c->piece + within, at, some);
        c->end += some, at += some, count -= some;
        if (some == left) put_line(c);
    }
}

void checks_seen(void *c, const char *bytes, size_t count) { checks_add(c, bytes, count); }

motus_status checks_mark(checks *c, motus_error *err)
{
    if (!c->path) return MOTUS_OK;
    if (c->end > c->said) put_line(c);
    return c->code ? file_cannot("write", c->path, c->code, err) : MOTUS_OK;
}

bool checks_sync(const checks *c) { return !c->path || disk_sync(c->descriptor); }

/* Returns whether there are only the lines of the pieces and the last line. */
static bool is_settled(const checks *c)
{
    const uint64_t pieces = c->end / CHECKS_PIECE - c->from / CHECKS_PIECE;
    return c->lines == pieces + (c->end > c->from && c->end % CHECKS_PIECE > 0);
}

/* Replaces FILE.check by one with only the lines of the pieces and the last line. */
static motus_status settle(checks *c, motus_error *err)
{
    motus_status status = file_create(&c->out, c->path, err);
    if (!status) status = file_text(&c->out, first_line, err);
    for (uint64_t k = 0; !status && k < c->lines; k++) {
        char line[LINE];
        uint64_t end, hash;
        if (file_read_at(c->descriptor, line, LINE, HEAD + k * LINE) != LINE || !read_line(line, &end, &hash))
            return file_cannot("read", c->path, errno, err);
        if (end % CHECKS_PIECE == 0 || end == c->end) status = file_write(&c->out, line, LINE, err);
    }
    if (!status) status = file_finish(&c->out, err);
    return status ? status : file_keep(&c->out, err);
}

motus_status checks_finish(checks *c, motus_error *err)
{
    if (!c->path) return MOTUS_OK;
    motus_status status = checks_mark(c, err);
    if (status) return status;
    if (!is_settled(c)) return settle(c, err);
    if (!c->out.stream) return checks_sync(c) ? MOTUS_OK : file_cannot("write", c->path, errno, err);
    c->descriptor = -1; /* file_finish() closes it */
    status = file_finish(&c->out, err);
    return status ? status : file_keep(&c->out, err);
}

/* ---- reading ---- */

/* Moves c->end to `end` if a line may end there and the bytes of the file have its hash. Returns whether it does. */
static bool follows(checks *c, int descriptor, uint64_t end, uint64_t hash)
{
    const uint64_t most = piece_of(c->end) + CHECKS_PIECE, before = c->end;
    if (end <= before || end > most) return false;
    const size_t count = (size_t)(end - before);
    if (file_read_at(descriptor, c->piece + before % CHECKS_PIECE, count, before) != (ssize_t)count) return false;
    c->end = end;
    if (hash_of(c) == hash) return true;
    c->end = before;
    return false;
}

motus_status checks_find(checks *c, const char *file, int descriptor, uint64_t from, motus_error *err)
{
    char line[LINE > HEAD ? LINE : HEAD];
    motus_status status = name_of(c, file, from, err);
    FILE *in = status ? NULL : fopen(c->path, "rbe");
    c->missing = !status && !in && errno == ENOENT;
    if (!in) return status || c->missing ? status : file_cannot("read", c->path, errno, err);
    const size_t got = fread(line, 1, HEAD, in);
    c->broken = memcmp(line, first_line, got) != 0;
    for (uint64_t end, hash; !c->broken && fread(line, 1, LINE, in) == LINE; c->lines++) {
        if (!read_line(line, &end, &hash)) break; /* a power cut may leave zeros */
        c->broken = !follows(c, descriptor, end, hash);
        if (c->broken) break;
    }
    if (ferror(in)) status = file_cannot("read", c->path, errno, err);
    fclose(in);
    return status;
}

motus_status checks_go_on(checks *c, int descriptor, uint64_t end, motus_error *err)
{
    char line[LINE];
    uint64_t hash;
    motus_status status = reopen(c, err);
    while (!status && c->lines > 0) {
        if (file_read_at(c->descriptor, line, LINE, HEAD + (c->lines - 1) * LINE) != LINE ||
            !read_line(line, &c->said, &hash))
            status = file_cannot("read", c->path, errno, err);
        if (status || c->said <= end) break;
        c->lines--;
    }
    if (status) return status;
    if (c->lines == 0) c->said = c->from;
    const uint64_t first = piece_of(end) > c->from ? piece_of(end) : c->from;
    const size_t count = (size_t)(end - first);
    if (ftruncate(c->descriptor, (off_t)(HEAD + c->lines * LINE)) != 0)
        return file_cannot("write", c->path, errno, err);
    if (file_read_at(descriptor, c->piece + first % CHECKS_PIECE, count, first) != (ssize_t)count)
        return fail(err, MOTUS_FILE, "cannot read the table that belongs to %s: %s", c->path, strerror(errno));
    c->end = end;
    return checks_mark(c, err);
}

motus_status checks_refuse(const checks *c, const char *file, motus_error *err)
{
    return complain(err, MOTUS_STATE, "restore it, or compute all rows again: --force instead of --resume",
                    "%s has rows, but %s is missing, which shows whether they are as they were written", file, c->path);
}

void checks_close(checks *c)
{
    if (c->descriptor > STDERR_FILENO && !c->out.stream) close(c->descriptor);
    file_drop(&c->out);
    free(c->path);
    c->path = NULL;
    c->descriptor = -1;
    c->from = c->end = c->lines = c->said = 0;
    c->code = 0;
    c->missing = c->broken = false;
}
