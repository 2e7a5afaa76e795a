/* The cache of compiled objects: $XDG_CACHE_HOME/motus/KEY.so. See cache.h.
 *
 * KEY is a hash of the C text, the options, the compiler (real path, size, time) and the processor's features, since
 * several machines may share a home directory. An entry is a shared object followed by a seal: a magic word, the
 * length, and a checksum of all before it. It is written under another name, sealed, and renamed; it is never changed
 * in place.
 *
 * Invariant: an entry is loaded only if it is a regular file, opened without following links, that the user owns and
 * only the user may write, in a directory of which the same holds, and if its seal is valid.
 */
#include "machine/cache.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

typedef struct hash {
    uint64_t a, b;
} hash;
typedef struct seal {
    char magic[8];
    uint64_t length;
    hash sum;
} seal;
static const char magic[8] = "motus so";

/* Two multiplicative hashes with different constants. They detect damage and tell texts apart; against an attacker the
 * owner and the mode of the file protect. */
static hash hash_bytes(hash h, const void *bytes, size_t n)
{
    const unsigned char *p = bytes;
    for (size_t i = 0; i < n; i++) {
        h.a = (h.a ^ p[i]) * 0x100000001B3u;
        h.b = (h.b + p[i] + 1) * 0x9E3779B97F4A7C15u;
        h.b ^= h.b >> 29;
    }
    return h;
}
static hash hash_text(hash h, const char *text) { return hash_bytes(h, text, strlen(text) + 1); }
static const hash hash_start = {0xCBF29CE484222325u, 0x6A09E667F3BCC908u};

/* What -march=native depends on. */
static hash hash_processor(hash h)
{
    char line[4096];
    FILE *f = fopen("/proc/cpuinfo", "re");
    while (f && fgets(line, sizeof line, f)) {
        bool wanted = !strncmp(line, "flags", 5) || !strncmp(line, "model", 5) || !strncmp(line, "cpu family", 10) ||
                      !strncmp(line, "vendor_id", 9) || !strncmp(line, "stepping", 8) ||
                      !strncmp(line, "Features", 8) || !strncmp(line, "CPU ", 4);
        if (wanted) h = hash_text(h, line);
        if (line[0] == '\n') break; /* all cores are alike */
    }
    if (f) fclose(f);
    return h;
}

/* ---- the directory ---- */

static bool privileged(void) { return geteuid() != getuid() || getegid() != getgid() || getenv("SUDO_UID") != NULL; }

static bool private_directory(int fd)
{
    struct stat s;
    return !fstat(fd, &s) && S_ISDIR(s.st_mode) && s.st_uid == geteuid() && !(s.st_mode & 022);
}

/* The directory; "" where there is none: under sudo or setuid, or without a home. */
static const char *directory_of(char *out, size_t size)
{
    const char *base = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    out[0] = 0;
    if (privileged()) return out;
    if (base && base[0] == '/')
        snprintf(out, size, "%s/motus", base);
    else if (home && home[0] == '/')
        snprintf(out, size, "%s/.cache/motus", home);
    if (strlen(out) + 64 > size) out[0] = 0;
    return out;
}

/* Opens the directory, which it makes where it is missing; -1: it cannot be made, or is not private. */
static int open_directory(const char *path)
{
    char up[PATH_MAX];
    snprintf(up, sizeof up, "%s", path);
    for (char *slash = strchr(up + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        mkdir(up, 0700);
        *slash = '/';
    }
    mkdir(path, 0700);
    int fd = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fd >= 0 && !private_directory(fd)) {
        close(fd);
        return -1;
    }
    return fd;
}

/* ---- entries ---- */

static bool sound(int fd)
{
    struct stat s;
    if (fstat(fd, &s) || !S_ISREG(s.st_mode) || s.st_uid != geteuid() || (s.st_mode & 022) ||
        s.st_size <= (off_t)sizeof(seal))
        return false;
    size_t n = (size_t)s.st_size;
    unsigned char *bytes = mmap(NULL, n, PROT_READ, MAP_PRIVATE, fd, 0);
    if (bytes == MAP_FAILED) return false;
    seal end;
    memcpy(&end, bytes + n - sizeof end, sizeof end);
    hash sum = hash_bytes(hash_start, bytes, n - sizeof end);
    munmap(bytes, n);
    return !memcmp(end.magic, magic, sizeof magic) && end.length == n - sizeof end && end.sum.a == sum.a &&
           end.sum.b == sum.b;
}

static void *load_sound(int directory, const char *name, const char *path)
{
    int fd = openat(directory, name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (fd < 0) return NULL;
    /* By its path, because the loader tells objects apart by name and /proc/self/fd/N would name several. Only the user
     * may write the directory, so the path still names the file that was checked. */
    void *handle = sound(fd) ? dlopen(path, RTLD_NOW | RTLD_LOCAL) : NULL;
    close(fd);
    return handle;
}

static bool write_all(int fd, const void *bytes, size_t n)
{
    const char *p = bytes;
    while (n > 0) {
        ssize_t k = write(fd, p, n);
        if (k < 0 && errno == EINTR) continue;
        if (k <= 0) return false;
        p += k;
        n -= (size_t)k;
    }
    return true;
}

static bool write_source(const char *path, const char *text, size_t length)
{
    int fd = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    bool ok = fd >= 0 && write_all(fd, text, length);
    if (fd >= 0) close(fd);
    return ok;
}

static bool put_seal(const char *path)
{
    int fd = open(path, O_RDWR | O_NOFOLLOW | O_CLOEXEC);
    struct stat s;
    seal end = {.length = 0};
    memcpy(end.magic, magic, sizeof magic);
    bool ok = fd >= 0 && !fchmod(fd, 0600) && !fstat(fd, &s) && s.st_size > 0;
    if (ok) {
        void *bytes = mmap(NULL, (size_t)s.st_size, PROT_READ, MAP_PRIVATE, fd, 0);
        ok = bytes != MAP_FAILED;
        if (ok) {
            end.length = (uint64_t)s.st_size;
            end.sum = hash_bytes(hash_start, bytes, (size_t)s.st_size);
            munmap(bytes, (size_t)s.st_size);
        }
    }
    ok = ok && lseek(fd, 0, SEEK_END) == s.st_size && write_all(fd, &end, sizeof end);
    if (fd >= 0) close(fd);
    return ok;
}

/* ---- folders that a killed process has left ---- */

enum { ABANDONED_SECONDS = 10 * COMPILER_SECONDS_MAX };

/* Removes the folder if it is old and holds nothing but files of a compilation. */
static void remove_folder(int parent, const char *name)
{
    struct stat s;
    int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    bool ours = fd >= 0 && !fstat(fd, &s) && s.st_uid == geteuid() && time(NULL) - s.st_mtime > ABANDONED_SECONDS;
    DIR *d = ours ? fdopendir(fd) : NULL;
    for (struct dirent *e; d && (e = readdir(d));)
        if (!strncmp(e->d_name, "model", 5) || !strncmp(e->d_name, "cc", 2)) /* ours, and the compiler's own */
            (void)unlinkat(fd, e->d_name, 0);
    if (d)
        closedir(d);
    else if (fd >= 0)
        close(fd);
    if (d) (void)unlinkat(parent, name, AT_REMOVEDIR);
}

/* A compiler writes files by name, so a process that is killed meanwhile leaves its folder; the next that compiles
 * removes it. `pattern`: the name that mkdtemp was given. */
static void remove_abandoned(const char *pattern)
{
    char parent[PATH_MAX + 80];
    snprintf(parent, sizeof parent, "%s", pattern);
    char *name = strrchr(parent, '/');
    *name++ = 0;
    const size_t n = strlen(name), fixed = n - strlen("XXXXXX");
    DIR *d = opendir(parent);
    for (struct dirent *e; d && (e = readdir(d));)
        if (strlen(e->d_name) == n && !strncmp(e->d_name, name, fixed)) remove_folder(dirfd(d), e->d_name);
    if (d) closedir(d);
}

/* Links, seals and loads what was compiled. The seal is not synchronised: after a power cut a damaged entry is found by
 * it, and compiled again. */
static void *link_and_load(const compiler *c, const char *object, const char *library, bool alone, char *why,
                           size_t size)
{
    void *handle = NULL;
    if (!compiler_link(c, object, library, alone, why, size))
        ;
    else if (!put_seal(library))
        snprintf(why, size, "%s cannot be written: %s", library, strerror(errno));
    else if (!(handle = dlopen(library, RTLD_NOW | RTLD_LOCAL)))
        snprintf(why, size, "%s", dlerror());
    return handle;
}

/* Compiles in a temporary directory, seals the library and, where there is a cache, renames it to `target`. */
static void *build(const compiler *c, const char *text, size_t length, int how, const char *target, char *why,
                   size_t size)
{
    char folder[PATH_MAX + 80], source[PATH_MAX + 96], object[PATH_MAX + 96], library[PATH_MAX + 96];
    if (target) {
        snprintf(folder, sizeof folder, "%s", target);
        *strrchr(folder, '/') = 0;
        strcat(folder, "/build-XXXXXX");
    } else {
        const char *tmp = getenv("TMPDIR");
        snprintf(folder, sizeof folder, "%s/motus-build-XXXXXX",
                 !privileged() && tmp && tmp[0] == '/' && strlen(tmp) < 512 ? tmp : "/tmp");
    }
    remove_abandoned(folder);
    if (!mkdtemp(folder)) {
        snprintf(why, size, "%s: %s", folder, strerror(errno));
        return NULL;
    }
    snprintf(source, sizeof source, "%s/model.c", folder);
    snprintf(object, sizeof object, "%s/model.o", folder);
    snprintf(library, sizeof library, "%s/model.so", folder);
    void *handle = NULL;
    if (!write_source(source, text, length))
        snprintf(why, size, "%s cannot be written: %s", source, strerror(errno));
    else if (compiler_run(c, source, object, how, why, size)) {
        handle = link_and_load(c, object, library, true, why, size);
        if (!handle) {
            unlink(library);
            handle = link_and_load(c, object, library, false, why, size);
        }
    }
    if (handle && target) rename(library, target);
    unlink(source);
    unlink(object);
    unlink(library);
    rmdir(folder);
    return handle;
}

void *cache_load(const char *text, size_t length, int how, char *why, size_t size)
{
    compiler c;
    if (!compiler_find(&c, why, size)) return NULL;
    char directory[PATH_MAX], path[PATH_MAX + 64], name[48];
    directory_of(directory, sizeof directory);
    int fd = directory[0] ? open_directory(directory) : -1;
    hash key =
        hash_processor(hash_text(hash_text(hash_bytes(hash_start, text, length), compiler_options(how)), c.identity));
    snprintf(name, sizeof name, "%016" PRIx64 "%016" PRIx64 ".so", key.a, key.b);
    snprintf(path, sizeof path, "%s/%s", directory, name);
    void *handle = fd >= 0 ? load_sound(fd, name, path) : NULL;
    if (!handle && how & CACHE_KEPT)
        snprintf(why, size, "it has not been compiled before");
    else if (!handle)
        handle = build(&c, text, length, how, fd >= 0 ? path : NULL, why, size);
    if (fd >= 0) close(fd);
    if (handle) *why = 0; /* what failed on the way does not matter */
    return handle;
}

int cache_clear(void)
{
    char directory[PATH_MAX];
    int fd = directory_of(directory, sizeof directory)[0]
                 ? open(directory, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)
                 : -1;
    if (fd < 0) return directory[0] && errno == ENOENT ? 0 : -1;
    DIR *d = fdopendir(fd);
    int count = 0;
    for (struct dirent *e; d && (e = readdir(d));) {
        size_t n = strlen(e->d_name);
        if (n == 35 && !strcmp(e->d_name + 32, ".so") && !unlinkat(fd, e->d_name, 0)) count++;
    }
    if (d) closedir(d);
    return count;
}
