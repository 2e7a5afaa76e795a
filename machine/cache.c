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

#include "base/platform.h"
#include "machine/build.h"

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

/* Adds bytes to two multiplicative hashes with different constants. They detect damage and tell texts apart; owner and
 * mode of the file protect against an attacker. */
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

static void add_line(void *h, const char *line) { *(hash *)h = hash_text(*(hash *)h, line); }

/* ---- the directory ---- */

static bool private_directory(int fd)
{
    struct stat s;
    return !fstat(fd, &s) && S_ISDIR(s.st_mode) && s.st_uid == geteuid() && !(s.st_mode & 022);
}

/* Writes and returns the directory; "": there is none, as under sudo or setuid, or without a home. */
static const char *directory_of(char *out, size_t size)
{
    const char *base = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    out[0] = 0;
    if (build_privileged()) return out;
    if (base && base[0] == '/')
        snprintf(out, size, "%s/motus", base);
    else if (home && home[0] == '/')
        snprintf(out, size, "%s/.cache/motus", home);
    if (strlen(out) + 64 > size) out[0] = 0;
    return out;
}

/* Opens the directory, and makes it if it is missing; -1: it cannot be made, or is not private. */
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
    /* Load by the path, because the loader tells objects apart by name, and /proc/self/fd/N would name several. Only
     * the user may write the directory, so the path still names the file that was checked. */
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

/* ---- an object in the making ---- */

struct cache_job {
    build build;
    char target[BUILD_PARENT_MAX]; /* the path of the entry; "": there is no cache */
    motus_allocator allocator;
};

/* Seals and loads the linked library and, where there is a cache, renames it. The file is not synchronised: after a
 * power cut the seal shows a damaged entry, which is compiled again. */
static void *load_linked(const cache_job *j, char *why, size_t size)
{
    char library[BUILD_FILE_MAX];
    void *handle = NULL;
    build_library(&j->build, library);
    if (!put_seal(library))
        snprintf(why, size, "%s cannot be written: %s", library, strerror(errno));
    else if (!(handle = dlopen(library, RTLD_NOW | RTLD_LOCAL)))
        snprintf(why, size, "%s", dlerror());
    if (handle && j->target[0]) rename(library, j->target);
    return handle;
}

/* Looks how far a job is. After any answer but WAIT the entry alone is left of it. */
static cache_state go_on(cache_job *j, void **handle, char *why, size_t size)
{
    const build_state state = build_look(&j->build, why, size);
    if (state == BUILD_WAIT) return CACHE_WAIT;
    if (state == BUILD_DONE) *handle = load_linked(j, why, size);
    if (state == BUILD_DONE && !*handle && build_relink(&j->build, why, size)) return CACHE_WAIT;
    build_end(&j->build);
    return *handle ? CACHE_READY : CACHE_FAILED;
}

/* Finds the object, or begins to make it. */
static cache_state begin(cache_job *j, void **handle, char *why, size_t size)
{
    build *b = &j->build;
    char directory[PATH_MAX], path[BUILD_PARENT_MAX], name[48];
    *handle = NULL;
    if (!compiler_find(&b->compiler, why, size)) return CACHE_FAILED;
    directory_of(directory, sizeof directory);
    int fd = directory[0] ? open_directory(directory) : -1;
    hash key = hash_text(hash_bytes(hash_start, b->text, b->length), compiler_options(b->how));
    key = hash_text(key, b->compiler.identity);
    platform_features(add_line, &key); /* on which -march=native depends */
    snprintf(name, sizeof name, "%016" PRIx64 "%016" PRIx64 ".so", key.a, key.b);
    snprintf(path, sizeof path, "%s/%s", directory, name);
    if (fd >= 0) *handle = load_sound(fd, name, path);
    if (fd >= 0) close(fd);
    if (*handle) return CACHE_READY;
    if (b->how & CACHE_KEPT) {
        snprintf(why, size, "it has not been compiled before");
        return CACHE_FAILED;
    }
    if (fd >= 0) snprintf(b->parent, sizeof b->parent, "%s", directory);
    if (fd >= 0) memcpy(j->target, path, sizeof path);
    return build_begin(b, why, size) ? CACHE_WAIT : CACHE_FAILED;
}

cache_state cache_begin(const char *text, size_t length, int how, const motus_allocator *allocator, cache_job **job,
                        void **handle, char *why, size_t size)
{
    *handle = NULL;
    cache_job *j = *job = take(allocator, 1, sizeof *j);
    if (!j) {
        snprintf(why, size, "out of memory");
        return CACHE_FAILED;
    }
    *j = (cache_job){.build = {.text = text, .length = length, .how = how}};
    if (allocator) j->allocator = *allocator;
    const cache_state state = begin(j, handle, why, size);
    if (state != CACHE_WAIT) give(allocator, j), *job = NULL;
    return state;
}

cache_state cache_look(cache_job **job, void **handle, char *why, size_t size)
{
    cache_job *j = *job;
    *handle = NULL;
    const cache_state state = go_on(j, handle, why, size);
    if (state == CACHE_WAIT) return state;
    const motus_allocator allocator = j->allocator;
    give(&allocator, j);
    *job = NULL;
    return state;
}

void cache_stop(cache_job *j)
{
    if (!j) return;
    build_end(&j->build);
    const motus_allocator allocator = j->allocator;
    give(&allocator, j);
}

enum { LOOKS = 5000 }; /* how often a second it looks whether the compiler has ended */

void *cache_load(const char *text, size_t length, int how, char *why, size_t size)
{
    const struct timespec nap = {0, 1000000000 / LOOKS};
    cache_job j = {.build = {.text = text, .length = length, .how = how}};
    void *handle;
    cache_state state = begin(&j, &handle, why, size);
    while (state == CACHE_WAIT) {
        nanosleep(&nap, NULL);
        state = go_on(&j, &handle, why, size);
    }
    if (handle) *why = 0; /* a failure on the way does not matter */
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
