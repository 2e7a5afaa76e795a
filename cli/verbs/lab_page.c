/* The page of the lab.
 *
 * Invariant: a page is written as it was built, except for the start in its one empty meta element; the only character
 * of the start with a meaning in HTML is &, which is written &amp;.
 */
#define _XOPEN_SOURCE 700
#include "cli/verbs/lab_page.h"

#include "cli/words/complain.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PAGE_MAX ((size_t)16 << 20) /* bytes of a page */
enum { PATH_ROOM = 4096 };

/* The folder of the program, from the system, else from the name it was called with. */
static bool program_folder(const char *called, char out[PATH_ROOM])
{
    char found[PATH_ROOM];
    ssize_t length = readlink("/proc/self/exe", out, PATH_ROOM);
    if (length > 0 && length < PATH_ROOM) {
        out[length] = 0;
    } else {
        const char *name = strchr(called, '/') ? called : file_program(called, found, sizeof found) ? found : NULL;
        char *real = name ? realpath(name, NULL) : NULL;
        bool fits = real && strlen(real) < PATH_ROOM;
        if (fits) strcpy(out, real);
        free(real);
        if (!fits) return false;
    }
    char *slash = strrchr(out, '/');
    if (slash) *slash = 0;
    return slash != NULL;
}

static motus_status find(char **path, const char *program, motus_error *err)
{
    static const char *const places[] = {"lab/motus-lab.html", MOTUS_LAB_INSTALLED};
    const char *named = getenv("MOTUS_LAB_PAGE");
    char folder[PATH_ROOM], candidate[PATH_ROOM + 256];
    if (named && *named) {
        *path = strdup(named);
        return *path ? MOTUS_OK : complain_memory(err);
    }
    bool known = program_folder(program, folder);
    for (size_t i = 0; known && i < sizeof places / sizeof *places; i++) {
        int n = snprintf(candidate, sizeof candidate, "%s/%s", folder, places[i]);
        if (n < 0 || (size_t)n >= sizeof candidate || access(candidate, F_OK) != 0) continue;
        *path = strdup(candidate);
        return *path ? MOTUS_OK : complain_memory(err);
    }
    return complain(err, MOTUS_FILE, "make lab builds it; MOTUS_LAB_PAGE may name another place",
                    "the page of the lab is missing: there is neither %s nor %s in %s", places[0], places[1],
                    known ? folder : "the folder of the program");
}

static motus_status not_a_page(const lab_page *p, const char *why, motus_error *err)
{
    return complain(err, MOTUS_FILE, "make lab builds it anew", "%s is not the page of the lab: %s", p->path, why);
}

motus_status lab_page_read(lab_page *p, const char *program, motus_error *err)
{
    static const char meta[] = "<meta name=\"motus-start\"", empty[] = " content=\"\">";
    *p = (lab_page){0};
    motus_status status = find(&p->path, program, err);
    if (!status) status = file_read(p->path, PAGE_MAX, &p->text, &p->length, err);
    if (status) return status;
    if (memchr(p->text, 0, p->length)) return not_a_page(p, "it has a byte 0", err);
    const char *found = strstr(p->text, meta);
    if (!found) return not_a_page(p, "it has no <meta name=\"motus-start\">", err);
    const char *rest = found + sizeof meta - 1;
    if (strstr(rest, meta)) return not_a_page(p, "it has two <meta name=\"motus-start\">", err);
    if (strncmp(rest, empty, sizeof empty - 1) != 0) return not_a_page(p, "its motus-start is not empty", err);
    p->place = (size_t)(rest - p->text) + strlen(" content=\"");
    return MOTUS_OK;
}

void lab_page_free(lab_page *p)
{
    free(p->path);
    free(p->text);
    *p = (lab_page){0};
}

motus_status lab_page_write(const lab_page *p, const char *start, file_out *f, motus_error *err)
{
    motus_status status = file_write(f, p->text, p->place, err);
    while (!status && *start) {
        size_t plain = strcspn(start, "&");
        status = file_write(f, start, plain, err);
        start += plain;
        if (!status && *start) {
            status = file_text(f, "&amp;", err);
            start++;
        }
    }
    return status ? status : file_write(f, p->text + p->place, p->length - p->place, err);
}
