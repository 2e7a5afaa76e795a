/* See target.h.
 *
 * Invariant: one program at a time writes a file of rows, if the file system has locks.
 */
#include "cli/files/target.h"

#include "base/disk.h"
#include "base/platform.h"
#include "cli/files/file.h"
#include "cli/words/complain.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), n = strlen(ending);
    return length > n && strcmp(path + length - n, ending) == 0;
}

bool target_npy(const char *path) { return ends_in(path, ".npy"); }
char *target_beside(const char *path) { return disk_beside(path, ".json"); }
bool target_archive(const char *path) { return ends_in(path, ".h5") || ends_in(path, ".hdf5"); }

/* The endings of files beside an archive: those of sweeps and runs, then those of merges. */
static const char *const endings[] = {".new", ARCHIVE_GROWN, ARCHIVE_GROWN ".new", ARCHIVE_JOINED,
                                      ARCHIVE_JOINED ".new"};
enum { OF_MERGES = 3, ENDINGS = 5 };

bool target_replaces(const char *archive, const char *input)
{
    bool same = false;
    char *name = disk_real(archive);
    for (size_t k = 0; name && !same && k < ENDINGS; k++) {
        char *beside = disk_beside(name, endings[k]);
        same = beside && file_same(beside, input);
        free(beside);
    }
    free(name);
    return same;
}

void target_tidy(const char *archive)
{
    char *name = disk_real(archive);
    for (size_t k = 0; name && k < OF_MERGES; k++) {
        char *beside = disk_beside(name, endings[k]);
        if (beside) remove(beside);
        free(beside);
    }
    free(name);
}

motus_status target_check(const options *o, const char *path, motus_error *err)
{
    const bool output = strcmp(path, "-") == 0;
    const char *const read = o->text ? NULL : o->operand;
    if (!*path) return fail(err, MOTUS_ARGUMENT, "the name of an output file is empty");
    if (read && !output && file_same(path, read))
        return fail(err, MOTUS_ARGUMENT, "%s is read and would be overwritten", read);
    if (read && target_archive(path) && target_replaces(path, read))
        return fail(err, MOTUS_ARGUMENT, "%s is read and would be overwritten while %s is made", read, path);
    struct stat about;
    if (output || o->plan || stat(path, &about) != 0) return MOTUS_OK; /* a plan writes no file */
    if (S_ISDIR(about.st_mode)) return fail(err, MOTUS_FILE, "cannot write %s: it is a folder", path);
    if (!S_ISREG(about.st_mode) && (o->resume || target_npy(path) || target_archive(path)))
        return fail(err, MOTUS_ARGUMENT, "%s is not a regular file: %s", path,
                    o->resume          ? "there is nothing to continue"
                    : target_npy(path) ? "a .npy must be one"
                                       : "an archive must be one");
    if (S_ISREG(about.st_mode) && about.st_size > 0 && !o->resume && !o->force) {
        const bool continued = o->verb == VERB_SWEEP ? path == o->output || path == o->events
                                                     : o->verb == VERB_RUN && target_archive(path);
        fail(err, MOTUS_ARGUMENT, "%s exists", path);
        hint(err, "%s--force replaces it", continued ? "--resume continues it, " : "");
        return MOTUS_ARGUMENT;
    }
    return MOTUS_OK;
}

/* The lock of an archive is behind its end, so that HDF5, which asks for a shared lock of the file, can read it
 * meanwhile. */
bool target_busy(const char *path, int descriptor) { return platform_locked(descriptor, target_archive(path)); }
bool target_take(const char *path, int descriptor) { return platform_lock(descriptor, target_archive(path)); }

motus_status target_lock(const char *path, int *descriptor, bool *regular, motus_error *err)
{
    struct stat about;
    *descriptor = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    const int code = errno;
    if (*descriptor < 0 && access(path, F_OK) == 0) /* a pipe or a device may not be readable */
        *descriptor = open(path, O_WRONLY | O_CLOEXEC);
    if (*descriptor < 0) errno = code;
    if (*descriptor < 0 || fstat(*descriptor, &about) != 0) return file_cannot("write", path, errno, err);
    *regular = S_ISREG(about.st_mode);
    if (!*regular) return MOTUS_OK;
    if (target_take(path, *descriptor)) {
        struct stat named; /* another program may have replaced the archive before it was locked */
        if (stat(path, &named) != 0 || (named.st_dev == about.st_dev && named.st_ino == about.st_ino)) return MOTUS_OK;
        close(*descriptor);
        return target_lock(path, descriptor, regular, err);
    }
    return complain(err, MOTUS_FILE, "wait for that sweep or run, or stop it", "%s is being written by another program",
                    path);
}

int target_bytes(int descriptor, const char *bytes, size_t count, size_t *written)
{
    for (*written = 0; *written < count;) {
        ssize_t more = write(descriptor, bytes + *written, count - *written);
        if (more < 0 && errno != EINTR) return errno;
        if (more > 0) *written += (size_t)more;
    }
    return 0;
}
