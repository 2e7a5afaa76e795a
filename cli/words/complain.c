/* Messages of the program.
 *
 * Invariant: an error is printed once: its place as file:line:column, its message, the line of the text with a caret,
 * and the hint. All of them pass text_put(), since they may contain words of a model or a file name.
 */
#include "cli/words/complain.h"

#include "cli/words/options.h"
#include "cli/words/text.h"
#include "tell/tell.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

motus_status complain_memory(motus_error *err) { return fail(err, MOTUS_MEMORY, "out of memory"); }

bool complain_colours(int descriptor)
{
    const char *no = getenv("NO_COLOR"), *terminal = getenv("TERM");
    return isatty(descriptor) && !(no && *no) && !(terminal && strcmp(terminal, "dumb") == 0);
}

/* "`until` of the definition" becomes --until, "`until = 3` of the definition" --until 3, and "`switches =
 * MOTUS_SWITCHES_STEP` of the definition" --switches step. */
void complain_named(const char *text, char *out, size_t size)
{
    static const char of[] = "` of the definition";
    size_t n = 0;
    while (*text && n + 3 < size) {
        const char *end = *text == '`' ? strchr(text + 1, '`') : NULL;
        const size_t word = end ? strcspn(text + 1, " `") : 0;
        if (!end || strncmp(end, of, strlen(of)) || !options_known(text + 1, word)) {
            out[n++] = *text++;
            continue;
        }
        const char *value = strncmp(text + 1 + word, " = ", 3) ? end : text + 4 + word;
        const bool constant = strncmp(value, "MOTUS_", 6) == 0;
        for (const char *c = value; constant && c < end; c++)
            if (*c == '_') value = c + 1;
        const size_t from = n;
        const char *const quote = memchr(value, ' ', (size_t)(end - value)) ? "\"" : "";
        n += (size_t)snprintf(out + n, size - n, "--%.*s%s%s%.*s%s", (int)word, text + 1, value < end ? " " : "", quote,
                              (int)(end - value), value, quote);
        for (size_t k = from; k < n && k < from + 2 + word; k++)
            if (out[k] == '_') out[k] = '-';
        for (size_t k = from; constant && k < n && k < size; k++)
            out[k] = (char)(out[k] + (out[k] >= 'A' && out[k] <= 'Z' ? 'a' - 'A' : 0));
        text = end + strlen(of);
    }
    out[n < size ? n : size - 1] = 0;
}

void complain_json(json *j, const char *key, const motus_error *err)
{
    char message[2 * MOTUS_TEXT_MAX + 2], help[sizeof err->hint];
    complain_named(err->hint, help, sizeof help);
    snprintf(message, sizeof message, "%s%s%s", err->message, help[0] ? "; " : "", help);
    json_open(j, key, '{');
    tell_error(j, err, message);
    json_close(j, '}');
}

/* Returns false if it cannot write. */
static bool show_json(const motus_error *err)
{
    json j = text_json(stdout);
    complain_json(&j, "error", err);
    tell_diagnosis(&j, err);
    json_end(&j);
    return fflush(stdout) == 0 && !ferror(stdout);
}

/* Prints "from: text". On a terminal it is wrapped; in a log a message is one line, which programs search. */
static void tell(const char *from, const char *text, size_t indent)
{
    text_put(stderr, from);
    fputs(": ", stderr);
    if (isatty(STDERR_FILENO))
        text_flow(stderr, text, text_width(from) + 2, indent, text_columns(stderr));
    else
        text_put(stderr, text);
}

int complain_show(const motus_error *given, bool as_json)
{
    motus_error own = *given, *err = &own;
    if (as_json && show_json(given)) return motus_status_exit(given->status);
    complain_named(given->hint, own.hint, sizeof own.hint);
    if (strcmp(own.file, "motus_text_def.set") == 0) snprintf(own.file, sizeof own.file, "--set");
    bool colours = complain_colours(2);
    const char *strong = colours ? "\033[1m" : "", *red = colours ? "\033[31m" : "", *plain = colours ? "\033[0m" : "";
    fflush(stdout);
    fputs(strong, stderr);
    char place[4096] = "motus";
    if (err->line > 0)
        snprintf(place, sizeof place, "%s:%d:%d", err->file[0] ? err->file : "model", err->line, err->column);
    tell(place, err->message, 4);
    fprintf(stderr, "%s\n", plain);
    if (err->source[0]) {
        fputs("    ", stderr);
        text_put(stderr, err->source);
        putc('\n', stderr);
    }
    if (err->source[0] && err->caret[0]) {
        fprintf(stderr, "    %s", red);
        text_put(stderr, err->caret);
        fprintf(stderr, "%s\n", plain);
    }
    if (err->hint[0]) {
        tell("  hint", err->hint, 8);
        putc('\n', stderr);
    }
    return motus_status_exit(err->status);
}

void complain_note(const char *format, ...)
{
    char raw[2 * MOTUS_TEXT_MAX], note[sizeof raw];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(raw, sizeof raw, format, arguments);
    va_end(arguments);
    complain_named(raw, note, sizeof note);
    fflush(stdout);
    tell("motus", note, 4);
    putc('\n', stderr);
}
