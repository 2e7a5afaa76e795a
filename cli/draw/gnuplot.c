/* gnuplot as a child process.
 *
 * Invariant: there is no shell, and gnuplot gets no file name from the user. Its input and its messages are temporary
 * files, so that the two processes cannot wait for each other for ever. The picture comes through a pipe, because
 * file_write() notices a full disk and gnuplot does not.
 */
#include "cli/draw/plot.h"
#include "cli/words/complain.h"

#include "cli/files/spawn.h"
#include "cli/files/stop.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

static motus_status missing(motus_error *err)
{
    return complain(err, MOTUS_TOOL, "sudo apt-get install gnuplot-nox",
                    "gnuplot is not installed; motus draws plots with it");
}

motus_status gnuplot_check(motus_error *err)
{
    char path[4096];
    return file_program("gnuplot", path, sizeof path) ? MOTUS_OK : missing(err);
}

motus_status gnuplot_open(gnuplot *g, motus_error *err)
{
    g->script = tmpfile();
    g->complaints = tmpfile();
    if (g->script && g->complaints) return MOTUS_OK;
    return fail(err, MOTUS_FILE, "cannot make a temporary file: %s", strerror(errno));
}

void gnuplot_close(gnuplot *g)
{
    if (g->script) fclose(g->script);
    if (g->complaints) fclose(g->complaints);
    *g = (gnuplot){0};
}

static motus_status copy_output(int from, file_out *picture, size_t *bytes, motus_error *err)
{
    char part[1 << 16];
    motus_status status = MOTUS_OK;
    *bytes = 0;
    while (!status && !stop_requested()) {
        ssize_t got = read(from, part, sizeof part);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        *bytes += (size_t)got;
        status = file_write(picture, part, (size_t)got, err);
    }
    return status;
}

/* Copies the first line with text in it, without leading blanks and gnuplot's caret. */
static void first_message(FILE *from, char *out, int size)
{
    out[0] = 0;
    rewind(from);
    while (fgets(out, size, from)) {
        size_t blanks = strspn(out, " \t\n^");
        out[strcspn(out, "\n")] = 0;
        if (blanks < strlen(out)) {
            memmove(out, out + blanks, strlen(out + blanks) + 1);
            return;
        }
    }
    out[0] = 0;
}

motus_status gnuplot_draw(gnuplot *g, file_out *picture, motus_error *err)
{
    if (fflush(g->script) != 0 || ferror(g->script) || fseek(g->script, 0, SEEK_SET) != 0)
        return fail(err, MOTUS_FILE, "cannot write a temporary file: %s", strerror(errno));
    int ends[2];
    if (pipe(ends) != 0) return fail(err, MOTUS_TOOL, "cannot start gnuplot: %s", strerror(errno));
    const int ours[] = {ends[0], ends[1], fileno(g->script), fileno(g->complaints)};
    for (size_t i = 0; i < sizeof ours / sizeof *ours; i++) (void)fcntl(ours[i], F_SETFD, FD_CLOEXEC);
    pid_t process;
    static char name[] = "gnuplot", defaults[] = "-d";
    char *const arguments[] = {name, defaults, NULL};
    int code = spawn_program(&process, arguments, (int[]){fileno(g->script), ends[1], fileno(g->complaints)}, false);
    close(ends[1]);
    if (code) {
        close(ends[0]);
        return code == ENOENT ? missing(err) : fail(err, MOTUS_TOOL, "cannot start gnuplot: %s", strerror(code));
    }
    size_t bytes;
    motus_status status = copy_output(ends[0], picture, &bytes, err);
    close(ends[0]); /* ends gnuplot if it still writes */
    int outcome = 0;
    pid_t waited;
    while ((waited = waitpid(process, &outcome, 0)) < 0 && errno == EINTR)
        ;
    if (stop_requested()) return fail(err, MOTUS_CANCELLED, "cancelled");
    if (status || (waited == process && WIFEXITED(outcome) && WEXITSTATUS(outcome) == 0 && bytes > 0)) return status;
    char words[200];
    first_message(g->complaints, words, sizeof words);
    return fail(err, MOTUS_TOOL, "gnuplot failed%s%s", words[0] ? ": " : "", words);
}
