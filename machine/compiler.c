/* Finding and running the system's C compiler. See compiler.h.
 *
 * Invariant: no shell is involved. The compiler has limits of time and memory. It leads a process group of its own,
 * because a compiler's driver starts further processes, and whoever stops it stops them with it. All of them end when
 * this process ends, however it does (Linux). No signal is handled: the compiler is asked after by its own number.
 */
#include "machine/compiler.h"

#include "base/platform.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* -fno-unroll-loops: clang would unroll every loop of unknown length, even those around a whole acceleration, which
 * doubles the time of compiling and made no measured model faster. gcc does not unroll such loops. */
/* clang-format off */
static const char *const options[] = {"-std=gnu17", "-march=native", "-ffp-contract=off", "-fno-math-errno",
    "-fno-stack-protector", "-fno-unroll-loops", "-fno-asynchronous-unwind-tables", "-fPIC", "-w", "-pipe",
    "-x", "c", "-c", NULL};
/* Long loops over arrays want vectors. In other texts the vectors are written out; vectorising what is left takes time,
 * and makes more models slower than faster. -fgcse takes a thirtieth of gcc's time and changed no measured speed. */
static const char *const loop_options[] = {"-O3", NULL};
static const char *const short_options[] = {"-O3", "-fno-tree-vectorize", "-fno-tree-slp-vectorize", "-fno-gcse", NULL};
/* --fast: the compiler may fuse products with sums and multiply by reciprocals. It may not reorder sums, which would
 * break compensated addition and the argument reductions of the elementary functions, nor assume finite numbers, which
 * would remove the test for divergence. */
static const char *const fast_options[] = {"-ffp-contract=fast", "-freciprocal-math", "-fno-signed-zeros",
    "-fno-trapping-math", NULL};
/* The linker alone takes a tenth of the time in which a compiler would find its own and call it. */
static const char *const linker_options[] = {"-shared", NULL};
/* When the compiler links: no start files and few libraries, since the object needs at most fmod and, on processors
 * without the instruction, fma; memcpy and memset come from the C library of the process. */
#ifdef __ELF__
static const char *const link_options[] = {"-shared", "-w", "-nostdlib", NULL};
static const char *const libraries[] = {"-Wl,--as-needed", "-lm", "-lgcc", NULL};
#else
static const char *const link_options[] = {"-shared", "-w", NULL};
static const char *const libraries[] = {"-lm", NULL};
#endif
/* clang-format on */
enum { ARGUMENTS_MAX = 40 };

const char *compiler_options(int how)
{
    static const char *const names[] = {"short", "loops", "short fast", "loops fast"};
    return names[(how & COMPILER_LOOPS ? 1 : 0) + (how & COMPILER_FAST ? 2 : 0)];
}

static bool executable(const char *path, compiler *c)
{
    char real[PATH_MAX];
    struct stat s;
    if (!realpath(path, real) || strlen(real) >= sizeof c->path || stat(real, &s) || !S_ISREG(s.st_mode) ||
        access(real, X_OK))
        return false;
    snprintf(c->path, sizeof c->path, "%s", real);
    snprintf(c->identity, sizeof c->identity, "%s %lld %lld.%09ld", real, (long long)s.st_size,
             (long long)s.st_mtim.tv_sec, s.st_mtim.tv_nsec);
    return true;
}

static bool search(const char *name, compiler *c)
{
    if (!*name) return false;
    if (strchr(name, '/')) return executable(name, c);
    const char *path = getenv("PATH");
    if (!path) path = "/usr/local/bin:/usr/bin:/bin";
    while (*path) {
        size_t n = strcspn(path, ":");
        char full[PATH_MAX];
        /* An empty or relative entry depends on the present directory, so no compiler is taken from it. */
        if (n > 0 && path[0] == '/' &&
            (size_t)snprintf(full, sizeof full, "%.*s/%s", (int)n, path, name) < sizeof full && executable(full, c))
            return true;
        path += n + (path[n] == ':');
    }
    return false;
}

bool compiler_find(compiler *c, char *why, size_t size)
{
    static const char *const names[] = {"cc", "gcc", "clang"};
    const char *mode = getenv("MOTUS_COMPILER"), *wanted = getenv("CC");
    if (mode && !strcmp(mode, "none")) {
        snprintf(why, size, "MOTUS_COMPILER=none forbids a compiler");
        return false;
    }
    if (wanted && *wanted) {
        if (search(wanted, c)) return true;
        snprintf(why, size, "CC is \"%s\", which is no program that can be run", wanted);
        return false;
    }
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (search(names[i], c)) return true;
    snprintf(why, size, "there is no C compiler (cc, gcc, clang, or the one named by CC)");
    return false;
}

extern char **environ;
enum { VARIABLES_MAX = 1024 };

/* Returns the environment with the object's folder for temporary files, which then go with the folder; unchanged if it
 * has too many variables. */
static char **with_folder(char *folder, char *own[VARIABLES_MAX])
{
    int n = 0;
    own[n++] = folder;
    for (char **one = environ; *one; one++) {
        if (n + 1 == VARIABLES_MAX) return environ;
        if (strncmp(*one, "TMPDIR=", 7) != 0) own[n++] = *one;
    }
    own[n] = NULL;
    return own;
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void first_line(int log, char *why, size_t size)
{
    char buffer[512];
    lseek(log, 0, SEEK_SET);
    ssize_t n = read(log, buffer, sizeof buffer - 1);
    buffer[n > 0 ? n : 0] = 0;
    buffer[strcspn(buffer, "\n")] = 0;
    snprintf(why, size, "%s", buffer[0] ? buffer : "it stopped without a message");
}

static void leave(compiler_work *w)
{
    close(w->log);
    if (w->tie >= 0) close(w->tie);
    w->child = 0;
}

/* Starts the program at `path` with the arguments, up to a NULL. */
static bool start(const char *path, char *const *arguments, const char *out, compiler_work *w, char *why, size_t size)
{
    char log_name[PATH_MAX];
    snprintf(log_name, sizeof log_name, "%s.log", out);
    int log = open(log_name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (log < 0) {
        snprintf(why, size, "%s", strerror(errno));
        return false;
    }
    unlink(log_name);
    char folder[PATH_MAX], *own[VARIABLES_MAX];
    const char *slash = strrchr(out, '/');
    snprintf(folder, sizeof folder, "TMPDIR=%.*s", (int)(slash ? slash - out : 1), slash ? out : ".");
    char **environment = with_folder(folder, own);
    *w = (compiler_work){.owner = getpid(), .log = log, .began = now()};
    w->child = platform_start(path, arguments, environment, log, COMPILER_SECONDS_MAX, COMPILER_MEMORY_MAX, &w->tie);
    if (w->child > 0) return true;
    snprintf(why, size, "%s", strerror(errno));
    leave(w);
    return false;
}

/* Tells whether the compiler has ended. A program that waits for all of its children may have taken the compiler's
 * status; then what the compiler wrote tells how it ended. */
static compiler_state ended(const compiler_work *w, const char *out)
{
    int status;
    pid_t got;
    do got = waitpid(w->child, &status, WNOHANG);
    while (got < 0 && errno == EINTR);
    if (got < 0) return access(out, F_OK) ? COMPILER_FAILED : COMPILER_DONE;
    if (got == 0) return COMPILER_AT_WORK;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) return COMPILER_LOST;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? COMPILER_DONE : COMPILER_FAILED;
}

bool compiler_owned(const compiler_work *w) { return w->owner == getpid(); }

/* Kills the compiler only while its number is certainly its own, because nobody has waited for it. */
static void end(compiler_work *w)
{
    if (!compiler_owned(w) || waitpid(w->child, NULL, WNOHANG) != 0) return;
    kill(-w->child, SIGKILL);
    while (waitpid(w->child, NULL, 0) < 0 && errno == EINTR) continue;
}

compiler_state compiler_look(compiler_work *w, const char *out, char *why, size_t size)
{
    const bool late = now() - w->began > COMPILER_SECONDS_MAX;
    compiler_state state = compiler_owned(w) ? ended(w, out) : COMPILER_LOST;
    if (state == COMPILER_AT_WORK && !late) return state;
    if (state == COMPILER_AT_WORK) end(w);
    if (late && state != COMPILER_DONE) state = COMPILER_FAILED;
    if (state != COMPILER_DONE) first_line(w->log, why, size);
    leave(w);
    return state;
}

void compiler_stop(compiler_work *w)
{
    if (!w->child) return;
    end(w);
    leave(w);
}

static int add(char **arguments, int n, const char *const *more)
{
    for (; *more; more++) arguments[n++] = (char *)*more;
    arguments[n] = NULL;
    return n;
}

bool compiler_compile(const compiler *c, const char *source, const char *object, int how, compiler_work *w, char *why,
                      size_t size)
{
    char *arguments[ARGUMENTS_MAX];
    int n = add(arguments, 0, (const char *const[]){c->path, NULL});
    n = add(arguments, n, options);
    n = add(arguments, n, how & COMPILER_LOOPS ? loop_options : short_options);
    if (how & COMPILER_FAST) n = add(arguments, n, fast_options);
    add(arguments, n, (const char *const[]){source, "-o", object, NULL});
    return start(c->path, arguments, object, w, why, size);
}

bool compiler_link(const compiler *c, const char *object, const char *library, bool alone, compiler_work *w, char *why,
                   size_t size)
{
    char *arguments[ARGUMENTS_MAX];
    const char *const files[] = {object, "-o", library, NULL};
    int n;
    if (alone) {
        compiler linker;
#ifndef __ELF__
        return false;
#endif
        if (!search("ld", &linker)) return false;
        n = add(arguments, 0, (const char *const[]){"ld", NULL});
        n = add(arguments, n, linker_options);
        add(arguments, n, files);
        return start(linker.path, arguments, library, w, why, size);
    }
    n = add(arguments, 0, (const char *const[]){c->path, NULL});
    n = add(arguments, n, link_options);
    n = add(arguments, n, files);
    add(arguments, n, libraries);
    return start(c->path, arguments, library, w, why, size);
}
