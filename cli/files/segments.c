/* See segments.h. */
#include "cli/files/segments.h"

#include "base/disk.h"
#include "cli/files/checks.h"
#include "cli/files/command.h"
#include "cli/files/file.h"
#include "cli/words/complain.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Where the rows of a block are. */
typedef struct stretch {
    size_t segment; /* 1 + the number of the segment; 0: none has the block */
    uint64_t at, length;
} stretch;

struct segments {
    const char *table, *head;
    bool (*same)(const char *, const char *);
    char *folder;
    uint64_t blocks;
    size_t first; /* the number to try first */
    stretch *of;  /* for each block */
    char **files; /* the segments that were found */
    size_t file_count;
    FILE *own; /* the segment of this process; NULL: it has not written yet */
    char *own_name;
    uint64_t length, hash; /* of the rows of the present block */
};

#define END "# end of block "
#define FOLDER ".segments"

motus_status segments_make(segments **out, const char *table, const char *head,
                           bool (*same)(const char *, const char *), uint64_t blocks, size_t first, motus_error *err)
{
    segments *s = *out = calloc(1, sizeof *s);
    if (!s) return complain_memory(err);
    s->table = table, s->head = head, s->same = same, s->blocks = blocks, s->first = first;
    s->hash = COMMAND_HASH;
    s->folder = disk_beside(table, FOLDER);
    return s->folder ? MOTUS_OK : complain_memory(err);
}

static void forget(segments *s)
{
    for (size_t k = 0; k < s->file_count; k++) free(s->files[k]);
    free(s->files);
    free(s->of);
    s->files = NULL, s->of = NULL, s->file_count = 0;
}

void segments_free(segments *s)
{
    if (!s) return;
    forget(s);
    if (s->own) fclose(s->own);
    free(s->own_name);
    free(s->folder);
    free(s);
}

/* ---- names: segment-1, segment-2 ... ---- */

static char *name_of(const segments *s, size_t number)
{
    char *name = malloc(strlen(s->folder) + 40);
    if (name) sprintf(name, "%s/segment-%zu", s->folder, number);
    return name;
}

static bool is_segment(const char *name)
{
    return strncmp(name, "segment-", 8) == 0 && name[8] && strspn(name + 8, "0123456789") == strlen(name + 8);
}

bool segments_there(const char *table)
{
    char *name = disk_beside(table, FOLDER);
    DIR *folder = name ? opendir(name) : NULL;
    bool there = name && !folder && errno != ENOENT; /* a file has the name of the folder */
    for (const struct dirent *entry; folder && (entry = readdir(folder));) there = there || is_segment(entry->d_name);
    if (folder) closedir(folder);
    free(name);
    return there;
}

static motus_status list(segments *s, motus_error *err)
{
    DIR *folder = opendir(s->folder);
    if (!folder) return errno == ENOENT ? MOTUS_OK : file_cannot("read", s->folder, errno, err);
    motus_status status = MOTUS_OK;
    errno = 0;
    for (const struct dirent *entry; !status && (entry = readdir(folder));) {
        if (!is_segment(entry->d_name)) continue;
        char **more = realloc(s->files, (s->file_count + 1) * sizeof *more);
        if (more) s->files = more;
        char *name = more ? malloc(strlen(s->folder) + strlen(entry->d_name) + 2) : NULL;
        if (!name) {
            status = complain_memory(err);
            break;
        }
        sprintf(name, "%s/%s", s->folder, entry->d_name);
        s->files[s->file_count++] = name;
        errno = 0;
    }
    if (!status && errno) status = file_cannot("read", s->folder, errno, err);
    closedir(folder);
    return status;
}

motus_status segments_remove(const segments *s, motus_error *err)
{
    DIR *folder = opendir(s->folder);
    if (!folder) return errno == ENOENT ? MOTUS_OK : file_cannot("remove", s->folder, errno, err);
    bool good = true;
    for (const struct dirent *entry; (entry = readdir(folder));)
        if (is_segment(entry->d_name)) good = unlinkat(dirfd(folder), entry->d_name, 0) == 0 && good;
    closedir(folder);
    if (good && (rmdir(s->folder) == 0 || errno == ENOTEMPTY || errno == EEXIST)) return MOTUS_OK;
    return file_cannot("remove", s->folder, errno, err);
}

/* ---- reading ---- */

/* Reads "# end of block 7, 1234 bytes, hash 0123456789abcdef\n". Returns whether the line is of this form. */
static bool read_end(const char *line, uint64_t *block, uint64_t *length, uint64_t *hash)
{
    int end = 0;
    return sscanf(line, END "%" SCNu64 ", %" SCNu64 " bytes, hash %" SCNx64 "%n", block, length, hash, &end) == 3 &&
           strcmp(line + end, "\n") == 0;
}

/* Reads the head of a segment and checks its sweep. *whole is false if the process was killed while it wrote the
 * head. */
static motus_status read_head(const segments *s, const char *name, FILE *in, bool *whole, motus_error *err)
{
    const size_t room = strlen(s->head) + 4096; /* a longer path may lead to the model */
    char *theirs = malloc(room);
    size_t used = 0;
    int lines = 0;
    if (!theirs) return complain_memory(err);
    for (int c; lines < 3 && used + 1 < room && (c = getc(in)) != EOF; lines += c == '\n') theirs[used++] = (char)c;
    theirs[used] = 0;
    /* a power cut may leave zeros for the bytes that were written last */
    *whole = lines == 3 && strncmp(theirs, "# motus sweep ", 14) == 0;
    const bool good = !*whole || s->same(s->head, theirs);
    free(theirs);
    if (good) return MOTUS_OK;
    return complain(err, MOTUS_STATE, "give the table of events another name, or start again with --force",
                    "%s has events of another sweep", name);
}

static motus_status read_segment(segments *s, size_t number, motus_error *err)
{
    const char *name = s->files[number];
    FILE *in = fopen(name, "rbe");
    if (!in) return file_cannot("read", name, errno, err);
    char *line = NULL;
    size_t room = 0;
    bool whole = false;
    motus_status status = read_head(s, name, in, &whole, err);
    uint64_t at = status ? 0 : (uint64_t)ftello(in), begin = at, hash = COMMAND_HASH;
    for (ssize_t got; !status && whole && (got = getline(&line, &room, in)) > 0; at += (uint64_t)got) {
        uint64_t block, length, its;
        if (strncmp(line, END, sizeof END - 1) != 0) {
            command_mix(&hash, line, (size_t)got);
            continue;
        }
        if (read_end(line, &block, &length, &its) && block < s->blocks && length == at - begin && its == hash)
            s->of[block] = (stretch){number + 1, begin, length};
        begin = at + (uint64_t)got;
        hash = COMMAND_HASH;
    }
    if (!status && whole && !feof(in))
        status = ferror(in) ? file_cannot("read", name, errno, err) : complain_memory(err);
    free(line);
    fclose(in);
    return status;
}

motus_status segments_find(segments *s, motus_error *err)
{
    forget(s);
    s->of = calloc((size_t)s->blocks + 1, sizeof *s->of);
    motus_status status = s->of ? list(s, err) : complain_memory(err);
    for (size_t k = 0; !status && k < s->file_count; k++) status = read_segment(s, k, err);
    return status;
}

bool segments_have(const segments *s, uint64_t block) { return s->of && s->of[block].segment > 0; }

/* ---- writing ---- */

static motus_status open_own(segments *s, motus_error *err)
{
    if (mkdir(s->folder, 0777) != 0 && errno != EEXIST) return file_cannot("make the folder", s->folder, errno, err);
    for (size_t number = s->first; !s->own; number++) {
        free(s->own_name);
        s->own_name = name_of(s, number);
        if (!s->own_name) return complain_memory(err);
        s->own = fopen(s->own_name, "wbxe"); /* fails if another process has this name */
        if (!s->own && errno != EEXIST) return file_cannot("write", s->own_name, errno, err);
    }
    return fputs(s->head, s->own) < 0 ? file_cannot("write", s->own_name, errno, err) : MOTUS_OK;
}

motus_status segments_put(segments *s, const char *rows, size_t length, motus_error *err)
{
    const motus_status status = s->own ? MOTUS_OK : open_own(s, err);
    if (status) return status;
    if (fwrite(rows, 1, length, s->own) != length) return file_cannot("write", s->own_name, errno, err);
    s->length += length;
    command_mix(&s->hash, rows, length);
    return MOTUS_OK;
}

motus_status segments_end_block(segments *s, uint64_t block, motus_error *err)
{
    const motus_status status = segments_put(s, "", 0, err);
    if (status) return status;
    if (fprintf(s->own, END "%" PRIu64 ", %" PRIu64 " bytes, hash %016" PRIx64 "\n", block, s->length, s->hash) < 0 ||
        fflush(s->own) != 0)
        return file_cannot("write", s->own_name, errno, err);
    s->length = 0;
    s->hash = COMMAND_HASH;
    return MOTUS_OK;
}

motus_status segments_finish(segments *s, motus_error *err)
{
    FILE *own = s->own;
    if (!own) return MOTUS_OK;
    s->own = NULL;
    const bool failed = fflush(own) != 0 || !disk_sync(fileno(own));
    const int code = failed ? errno : 0;
    if (fclose(own) == 0 && !code) return MOTUS_OK;
    if (code) errno = code;
    return file_cannot("write", s->own_name, errno, err);
}

/* ---- the table ---- */

static motus_status copy(const segments *s, const stretch *p, file_out *out, motus_error *err)
{
    enum { AT_ONCE = 1 << 16 };
    char bytes[AT_ONCE];
    const char *name = s->files[p->segment - 1];
    FILE *in = fopen(name, "rbe");
    if (!in) return file_cannot("read", name, errno, err);
    motus_status status = fseeko(in, (off_t)p->at, SEEK_SET) == 0 ? MOTUS_OK : file_cannot("read", name, errno, err);
    for (uint64_t left = p->length; !status && left > 0;) {
        const size_t some = left < AT_ONCE ? (size_t)left : AT_ONCE;
        errno = 0;
        status = fread(bytes, 1, some, in) == some ? file_write(out, bytes, some, err)
                                                   : file_cannot("read", name, errno, err);
        left -= some;
    }
    fclose(in);
    return status;
}

static motus_status look(const segments *s, motus_error *err)
{
    uint64_t missing = 0;
    for (uint64_t b = 0; b < s->blocks; b++) missing += !segments_have(s, b);
    if (!missing) return MOTUS_OK;
    return complain(err, MOTUS_FILE, "--resume computes them again",
                    "the events of %" PRIu64 " of %" PRIu64 " blocks were written, but are not in %s", missing,
                    s->blocks, s->folder);
}

motus_status segments_join(segments *s, const char *last, stop_progress *progress, motus_error *err)
{
    file_out out = {0};
    checks c = {.descriptor = -1};
    motus_status status = segments_find(s, err);
    if (!status) status = look(s, err);
    if (!status) status = file_create(&out, s->table, err);
    if (!status) status = checks_begin(&c, s->table, 0, true, err);
    out.seen = checks_seen, out.with = &c;
    if (!status) status = file_text(&out, s->head, err);
    for (uint64_t b = 0; !status && b < s->blocks; b++) {
        status = copy(s, &s->of[b], &out, err);
        if (!status && stop_progress_hook(progress, 1)) status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    out.seen = NULL;
    if (!status) status = file_text(&out, last, err);
    if (!status) status = file_finish(&out, err);
    if (!status) status = checks_finish(&c, err);
    if (!status) status = file_keep(&out, err);
    file_drop(&out);
    checks_close(&c);
    return status ? status : segments_remove(s, err);
}
