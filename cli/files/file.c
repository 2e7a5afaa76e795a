/* Files: read up to a bound, written completely or not at all.
 *
 * Invariant: the file that the user named is complete and on the disk, or what it was before. A temporary file lies in
 * its folder, because a rename is atomic only within a file system. On Linux it has no name until it is complete, and
 * vanishes with a killed program.
 */
#include "cli/files/file.h"

#include "base/disk.h"
#include "base/platform.h"
#include "cli/files/stop.h"
#include "cli/words/complain.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *called(const char *path, bool reading)
{
    return strcmp(path, "-") == 0 ? reading ? "standard input" : "standard output" : path;
}

motus_status file_cannot(const char *what, const char *path, int code, motus_error *err)
{
    return fail(err, MOTUS_FILE, "cannot %s %s: %s", what, path, strerror(code ? code : EIO));
}

motus_status file_cannot_write(const char *path, int code, motus_error *err)
{
    if (code == EPIPE && strcmp(path, "-") == 0) stop_reader_gone();
    return file_cannot("write", called(path, false), code, err);
}

static motus_status too_long(const char *path, size_t most, motus_error *err)
{
    return complain(err, MOTUS_LIMIT, "check that this is the file you meant", "%s is longer than %zu bytes",
                    called(path, true), most);
}

static motus_status cannot_read(const char *path, const char *why, motus_error *err)
{
    return fail(err, MOTUS_FILE, "cannot read %s: %s", called(path, true), why);
}

static motus_status read_all(FILE *in, const char *path, size_t most, size_t guess, char **text, size_t *length,
                             motus_error *err)
{
    size_t room = guess < most ? guess + 2 : most + 2, used = 0;
    char *buffer = malloc(room);
    if (!buffer) return complain_memory(err);
    for (;;) {
        if (used + 1 == room) {
            char *larger = realloc(buffer, room *= 2);
            if (!larger) {
                free(buffer);
                return complain_memory(err);
            }
            buffer = larger;
        }
        errno = 0;
        const size_t got = fread(buffer + used, 1, room - used - 1, in);
        used += got;
        if (got > 0 && used <= most) continue;
        if (got == 0 && !ferror(in)) break;
        const int code = errno;
        free(buffer);
        return used > most ? too_long(path, most, err) : cannot_read(path, strerror(code), err);
    }
    buffer[used] = 0;
    *text = buffer;
    *length = used;
    return MOTUS_OK;
}

/* Waits for a program that writes a named pipe, but not for ever. *first is a byte that was read, or remains EOF. */
static motus_status wait_for_writer(int fd, const char *path, int *first, motus_error *err)
{
    enum { WAIT_MS = 10000 };
    struct pollfd in = {.fd = fd, .events = POLLIN};
    unsigned char byte;
    if (poll(&in, 1, WAIT_MS) > 0) return MOTUS_OK;
    const ssize_t got = read(fd, &byte, 1);
    if (got > 0) *first = byte;
    if (got != 0) return MOTUS_OK;
    return complain(err, MOTUS_FILE, "start the program that writes it first",
                    "cannot read %s: it is a pipe, and no program has opened it to write within %d s", path,
                    WAIT_MS / 1000);
}

motus_status file_open(const char *path, FILE **in, motus_error *err)
{
    struct stat about;
    int first = EOF;
    *in = NULL;
    const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (fd < 0) return cannot_read(path, strerror(errno), err);
    motus_status status = MOTUS_OK;
    if (fstat(fd, &about) != 0)
        status = cannot_read(path, strerror(errno), err);
    else if (S_ISDIR(about.st_mode))
        status = cannot_read(path, "it is a folder", err);
    else if (!S_ISREG(about.st_mode) && !S_ISFIFO(about.st_mode) && !isatty(fd))
        status = cannot_read(path, "it is a device, not a file or a pipe", err);
    else if (S_ISFIFO(about.st_mode))
        status = wait_for_writer(fd, path, &first, err);
    const int flags = fcntl(fd, F_GETFL);
    if (!status && (flags < 0 || fcntl(fd, F_SETFL, flags & ~O_NONBLOCK) < 0 || !(*in = fdopen(fd, "r"))))
        status = cannot_read(path, strerror(errno), err);
    if (status)
        close(fd);
    else if (first != EOF)
        ungetc(first, *in);
    return status;
}

motus_status file_read(const char *path, size_t most, char **text, size_t *length, motus_error *err)
{
    if (strcmp(path, "-") == 0) return read_all(stdin, path, most, 4096, text, length, err);
    FILE *in;
    struct stat about;
    motus_status status = file_open(path, &in, err);
    if (status) return status;
    const bool regular = fstat(fileno(in), &about) == 0 && S_ISREG(about.st_mode) && about.st_size > 0;
    if (regular && (uintmax_t)about.st_size > most)
        status = too_long(path, most, err);
    else
        status = read_all(in, path, most, regular ? (size_t)about.st_size : 4096, text, length, err);
    fclose(in);
    return status;
}

ssize_t file_read_at(int descriptor, void *out, size_t count, uint64_t place)
{
    size_t done = 0;
    while (done < count) {
        const ssize_t got = pread(descriptor, (char *)out + done, count - done, (off_t)(place + done));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) break;
        done += (size_t)got;
    }
    return (ssize_t)done;
}

bool file_same(const char *a, const char *b)
{
    struct stat first, second;
    if (strcmp(a, "-") == 0 || strcmp(b, "-") == 0) return strcmp(a, b) == 0;
    if (strcmp(a, b) == 0) return true;
    return stat(a, &first) == 0 && stat(b, &second) == 0 && S_ISREG(first.st_mode) && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino;
}

bool file_program(const char *name, char *path, size_t size)
{
    const char *folders = getenv("PATH");
    if (!folders || !*folders) folders = "/usr/local/bin:/usr/bin:/bin";
    while (*folders) {
        size_t length = strcspn(folders, ":");
        int n = snprintf(path, size, "%.*s%s%s", (int)length, folders, length ? "/" : "./", name);
        if (n > 0 && (size_t)n < size && access(path, X_OK) == 0) return true;
        folders += length + (folders[length] == ':');
    }
    return false;
}

static motus_status cannot_write(file_out *f, motus_error *err) { return file_cannot_write(f->path, f->code, err); }

/* Opens a file without a name in the folder of f->path. Returns -1 if it cannot: see platform_nameless(). */
static int open_nameless(file_out *f)
{
    const int fd = disk_nameless(f->path, 0600);
    const int kept = fd >= 0 ? fcntl(fd, F_DUPFD_CLOEXEC, 0) : -1;
    if (kept >= 0) {
        f->nameless = kept + 1;
        return fd;
    }
    if (fd >= 0) close(fd);
    return -1;
}

static bool name_temporary(file_out *f)
{
    static const char name[] = ".motus-XXXXXX";
    const char *slash = strrchr(f->path, '/');
    const size_t folder = slash ? (size_t)(slash - f->path) + 1 : 0;
    f->temporary = malloc(folder + sizeof name);
    if (!f->temporary) return false;
    memcpy(f->temporary, f->path, folder);
    memcpy(f->temporary + folder, name, sizeof name);
    return true;
}

/* Creates a file in the folder of f->path, with the access rights of the final file. */
static motus_status create_beside(file_out *f, mode_t mode, motus_error *err)
{
    int fd = open_nameless(f);
    if (fd < 0) {
        if (!name_temporary(f)) return complain_memory(err);
        fd = mkstemp(f->temporary);
    }
    if (fd < 0) {
        f->code = errno;
        free(f->temporary);
        f->temporary = NULL;
        return cannot_write(f, err);
    }
    (void)fcntl(fd, F_SETFD, FD_CLOEXEC);
    (void)fchmod(fd, mode); /* fails on a file system without access rights, which is harmless */
    f->stream = fdopen(fd, "w");
    if (!f->stream) {
        close(fd);
        return complain_memory(err);
    }
    return MOTUS_OK;
}

motus_status file_create(file_out *f, const char *path, motus_error *err)
{
    *f = (file_out){0};
    struct stat about;
    bool output = strcmp(path, "-") == 0, exists = !output && stat(path, &about) == 0;
    if (!*path) return fail(err, MOTUS_ARGUMENT, "the name of an output file is empty");
    /* the target of a link is replaced, not the link */
    f->path = exists && S_ISREG(about.st_mode) ? realpath(path, NULL) : NULL;
    if (!f->path) f->path = strdup(path);
    if (!f->path) return complain_memory(err);
    f->direct = output || (exists && !S_ISREG(about.st_mode));
    if (output) {
        f->stream = stdout;
        return MOTUS_OK;
    }
    if (exists && S_ISDIR(about.st_mode)) {
        f->code = EISDIR;
        return cannot_write(f, err);
    }
    if (exists && !S_ISREG(about.st_mode)) {
        int fd = open(path, O_WRONLY | O_CLOEXEC);
        f->stream = fd < 0 ? NULL : fdopen(fd, "w");
        if (f->stream) return MOTUS_OK;
        f->code = errno;
        if (fd >= 0) close(fd);
        return cannot_write(f, err);
    }
    /* rename() would replace a read-only file too */
    if (exists && access(f->path, W_OK) != 0) {
        f->code = errno;
        return cannot_write(f, err);
    }
    mode_t mask = umask(0);
    umask(mask);
    return create_beside(f, exists ? about.st_mode & 07777 : 0666 & ~mask, err);
}

motus_status file_write(file_out *f, const char *bytes, size_t count, motus_error *err)
{
    if (f->code == 0 && fwrite(bytes, 1, count, f->stream) != count) f->code = errno ? errno : EIO;
    if (f->code == 0 && f->seen) f->seen(f->with, bytes, count);
    return f->code ? cannot_write(f, err) : MOTUS_OK;
}

motus_status file_text(file_out *f, const char *text, motus_error *err)
{
    return file_write(f, text, strlen(text), err);
}

motus_status file_finish(file_out *f, motus_error *err)
{
    if (!f->stream) return MOTUS_OK;
    if (f->code == 0 && (fflush(f->stream) != 0 || ferror(f->stream))) f->code = errno ? errno : EIO;
    if (f->code == 0 && !f->direct && !disk_sync(fileno(f->stream))) f->code = errno;
    if (f->stream != stdout && fclose(f->stream) != 0 && f->code == 0) f->code = errno;
    f->stream = NULL;
    return f->code ? cannot_write(f, err) : MOTUS_OK;
}

motus_status file_keep(file_out *f, motus_error *err)
{
    if (!f->nameless && !f->temporary) return MOTUS_OK;
    if (f->nameless ? !disk_name(f->nameless - 1, f->path) : !disk_replace(f->temporary, f->path)) {
        f->code = errno;
        return cannot_write(f, err);
    }
    if (f->nameless) close(f->nameless - 1);
    f->nameless = 0;
    free(f->temporary);
    f->temporary = NULL;
    return MOTUS_OK;
}

void file_drop(file_out *f)
{
    if (f->stream && f->stream != stdout) fclose(f->stream);
    if (f->nameless) close(f->nameless - 1);
    if (f->temporary) unlink(f->temporary);
    free(f->temporary);
    free(f->path);
    *f = (file_out){0};
}

motus_status file_memory_open(file_memory *m, motus_error *err)
{
    static char name[] = "memory";
    *m = (file_memory){0};
    m->file = (file_out){.stream = open_memstream(&m->text, &m->length), .path = name};
    return m->file.stream ? MOTUS_OK : complain_memory(err);
}

motus_status file_memory_close(file_memory *m, motus_status status, motus_error *err)
{
    if (!m->file.stream) return status;
    const bool failed = ferror(m->file.stream) != 0;
    return (fclose(m->file.stream) != 0 || failed) && !status ? complain_memory(err) : status;
}

motus_status file_beside_make(file_beside *f, const char *name, const char *ending, motus_error *err)
{
    char place[PLATFORM_PLACE];
    *f = (file_beside)FILE_BESIDE;
    f->name = disk_real(name);
    f->descriptor = f->name ? disk_nameless(f->name, 0666) : -1;
    f->path = f->descriptor >= 0 ? strdup(platform_place(f->descriptor, place))
              : f->name          ? disk_beside(f->name, ending)
                                 : NULL;
    return f->path ? MOTUS_OK : complain_memory(err);
}

motus_status file_beside_keep(file_beside *f, motus_error *err)
{
    if (f->descriptor >= 0 ? !disk_name(f->descriptor, f->name) : !disk_replace(f->path, f->name))
        return file_cannot("write", f->name, errno, err);
    if (f->descriptor >= 0) close(f->descriptor);
    f->descriptor = -1;
    free(f->path);
    f->path = NULL;
    return MOTUS_OK;
}

static void put_name(char *text, size_t size, const char *path, const char *name)
{
    char whole[2 * MOTUS_TEXT_MAX], *at = strstr(text, path);
    if (!at) return;
    snprintf(whole, sizeof whole, "%.*s%.400s%s", (int)(at - text), text, name, at + strlen(path));
    snprintf(text, size, "%.*s", (int)size - 1, whole);
}

void file_beside_complain(const file_beside *f, const char *name, motus_error *err)
{
    if (!err || !f->path) return;
    put_name(err->message, sizeof err->message, f->path, name);
    put_name(err->hint, sizeof err->hint, f->path, name);
}

void file_beside_drop(file_beside *f)
{
    if (f->descriptor >= 0)
        close(f->descriptor);
    else if (f->path)
        unlink(f->path);
    free(f->name);
    free(f->path);
    *f = (file_beside)FILE_BESIDE;
}

/* Opens input for writing and output for reading, so that using them is an error. */
void file_open_standard(void)
{
    for (int wanted = STDIN_FILENO; wanted <= STDERR_FILENO; wanted++) {
        if (fcntl(wanted, F_GETFD) >= 0) continue;
        if (open("/dev/null", wanted == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) (void)open("/", O_RDONLY);
    }
}

bool file_output_closed(void)
{
    const int mode = fcntl(STDOUT_FILENO, F_GETFL);
    return mode < 0 || (mode & O_ACCMODE) == O_RDONLY;
}

motus_status file_flush_output(motus_error *err)
{
    const int before = ferror(stdout) ? errno : 0; /* of an earlier write that failed */
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) return MOTUS_OK;
    const int code = errno ? errno : before ? before : EIO;
    return file_cannot_write("-", code, err);
}
