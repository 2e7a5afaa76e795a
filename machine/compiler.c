/* Finding and running the system's C compiler. See compiler.h.
 *
 * Invariant: no shell is involved. The compiler has limits of time and memory. It ends when this process ends (Linux),
 * or by the terminal's signal, since it stays in the same process group.
 */
#include "machine/compiler.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

/* -fno-unroll-loops: clang would unroll every loop of unknown length, even those around a whole acceleration, which
 * doubles the time of compiling and made no measured model faster. gcc does not unroll such loops. */
static const char *const options[] = {"-std=gnu17",
                                      "-O3",
                                      "-march=native",
                                      "-ffp-contract=off",
                                      "-fno-math-errno",
                                      "-fno-stack-protector",
                                      "-fno-unroll-loops",
                                      "-fPIC",
                                      "-shared",
                                      "-w",
                                      "-x",
                                      "c"};
/* Without start files and with few libraries, because linking the rest would take longer than compiling a small model.
 * The object needs at most fmod and, on processors without the instruction, fma; memcpy and memset come from the C
 * library of the process. */
#ifdef __ELF__
static const char *const libraries[] = {"-nostdlib", "-Wl,--as-needed", "-lm", "-lgcc"};
#else
static const char *const libraries[] = {"-lm"};
#endif
enum { OPTIONS = sizeof options / sizeof *options, LIBRARIES = sizeof libraries / sizeof *libraries };

/* --fast: the compiler may fuse products with sums and multiply by reciprocals. It may not reorder sums, which would
 * break compensated addition and the argument reductions of the elementary functions, nor assume finite numbers, which
 * would remove the test for divergence. */
static const char *const fast_options[] = {"-ffp-contract=fast", "-freciprocal-math", "-fno-signed-zeros",
                                           "-fno-trapping-math"};
enum { FAST_OPTIONS = sizeof fast_options / sizeof *fast_options };

const char *compiler_options(bool fast)
{
    return fast ? "gnu17 O3 native contract reciprocal nomatherrno noprotector nounroll nostdlib"
                : "gnu17 O3 native nocontract nomatherrno noprotector nounroll nostdlib";
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

bool compiler_find(compiler *c)
{
    const char *names[] = {getenv("CC"), "cc", "gcc", "clang"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (names[i] && search(names[i], c)) return true;
    return false;
}

extern char **environ;
enum { VARIABLES_MAX = 1024 };

/* The environment with the object's folder for temporary files, which then go with the folder; as it is where it has
 * too many variables. */
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

/* In the child: only calls that are safe after fork. */
static void become_compiler(char *const *arguments, const char *path, char *folder, int log, pid_t parent)
{
    char *own[VARIABLES_MAX];
    struct rlimit time = {COMPILER_SECONDS_MAX, COMPILER_SECONDS_MAX},
                  memory = {COMPILER_MEMORY_MAX, COMPILER_MEMORY_MAX}, core = {0, 0};
    setrlimit(RLIMIT_CPU, &time);
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &core);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(127);
#else
    (void)parent;
#endif
    int none = open("/dev/null", O_RDWR);
    if (none >= 0) dup2(none, 0);
    dup2(log, 1);
    dup2(log, 2);
    execve(path, arguments, with_folder(folder, own));
    _exit(127);
}

static bool wait_for(pid_t child)
{
    struct timespec nap = {0, 2000000};
    for (int i = 0; i < COMPILER_SECONDS_MAX * 500; i++) {
        int status;
        pid_t ended = waitpid(child, &status, WNOHANG);
        if (ended == child) return WIFEXITED(status) && WEXITSTATUS(status) == 0;
        if (ended < 0 && errno != EINTR) return false;
        nanosleep(&nap, NULL);
    }
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    return false;
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

bool compiler_run(const compiler *c, const char *source, const char *object, bool fast, char *why, size_t size)
{
    char log_name[PATH_MAX];
    snprintf(log_name, sizeof log_name, "%s.log", object);
    int log = open(log_name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (log < 0) {
        snprintf(why, size, "%s", strerror(errno));
        return false;
    }
    unlink(log_name);
    char *arguments[OPTIONS + FAST_OPTIONS + LIBRARIES + 5];
    int n = 0;
    arguments[n++] = (char *)c->path;
    for (int i = 0; i < OPTIONS; i++) arguments[n++] = (char *)options[i];
    for (int i = 0; fast && i < FAST_OPTIONS; i++) arguments[n++] = (char *)fast_options[i];
    arguments[n++] = (char *)source;
    arguments[n++] = "-o";
    arguments[n++] = (char *)object;
    for (int i = 0; i < LIBRARIES; i++) arguments[n++] = (char *)libraries[i];
    arguments[n] = NULL;
    char folder[PATH_MAX];
    const char *slash = strrchr(object, '/');
    snprintf(folder, sizeof folder, "TMPDIR=%.*s", (int)(slash ? slash - object : 1), slash ? object : ".");
    pid_t parent = getpid(), child = fork();
    if (child == 0) become_compiler(arguments, c->path, folder, log, parent);
    bool ok = child > 0 && wait_for(child);
    if (!ok) first_line(log, why, size);
    close(log);
    return ok;
}
