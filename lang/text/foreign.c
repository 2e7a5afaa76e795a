/* How other languages write what a text may mean. See foreign.h. */
#include "lang/text/foreign.h"

#include "lang/text/words.h"

#include <stdio.h>
#include <string.h>

enum { SHOWN = 80 };

static bool digit(char c) { return c >= '0' && c <= '9'; }
static char small(char c) { return (char)(c >= 'A' && c <= 'Z' ? c + 'a' - 'A' : c); }
static bool in_name(char c) { return digit(c) || (small(c) >= 'a' && small(c) <= 'z') || c == '_' || (c & 0x80); }
static bool blank(char c) { return c == ' ' || c == '\t'; }

/* Returns the place of the bracket that matches the one at `at`, in a direction; `at` itself where there is none. */
static uint32_t matching(const struct source_text *t, uint32_t at, int way)
{
    int depth = 0;
    for (uint32_t i = at; i < t->length && t->bytes[i] != '\n'; i += (uint32_t)way) {
        depth += strchr("([", t->bytes[i]) ? 1 : strchr(")]", t->bytes[i]) ? -1 : 0;
        if (depth == 0) return i;
    }
    return at;
}

span foreign_before(const source *s, const span *at)
{
    const struct source_text *t = &s->texts[at->text];
    uint32_t to = at->from, from;
    while (to > 0 && blank(t->bytes[to - 1])) to--;
    for (from = to; from > 0; from--) {
        const char c = t->bytes[from - 1];
        if (c == ')' || c == ']') from = matching(t, from - 1, -1) + 1;
        if (c != ')' && c != ']' && c != '\'' && c != '.' && !in_name(c)) break;
    }
    return (span){at->text, from, to};
}

span foreign_after(const source *s, const span *at)
{
    const struct source_text *t = &s->texts[at->text];
    uint32_t from = at->to, to;
    while (from < t->length && blank(t->bytes[from])) from++;
    for (to = from; to < t->length; to++) {
        const char c = t->bytes[to];
        if (c == '(' || c == '[') to = matching(t, to, 1);
        if (c != '(' && c != '[' && c != '\'' && c != '.' && !in_name(c)) break;
    }
    return (span){at->text, from, to};
}

/* Returns a part of a text without blanks, colons and brackets around it. */
static const char *trimmed(const source *s, uint32_t text, uint32_t from, uint32_t to, char out[SHOWN])
{
    const char *bytes = s->texts[text].bytes;
    while (from < to && (blank(bytes[from]) || bytes[from] == ':')) from++;
    while (to > from && (blank(bytes[to - 1]) || bytes[to - 1] == ':')) to--;
    if (to > from + 4 && !memcmp(bytes + to - 4, " end", 4)) to -= 4;
    if (from == to) return "…";
    if (bytes[from] == '(' && matching(&s->texts[text], from, 1) == to - 1) from++, to--;
    return source_excerpt(s, &(span){text, from, to}, out, SHOWN);
}

static bool listed(const char *words, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = words; (at = strstr(at, name)); at++)
        if ((at == words || at[-1] == ' ') && (at[length] == ' ' || !at[length])) return true;
    return false;
}

/* Names ------------------------------------------------------------------------------------------------------------ */

static const char units[] =
    "kg g mg t lb oz m km cm mm um nm ft in mi AU au pc ly s ms us ns sec min h hr hour day days year yr N kN J kJ MJ "
    "eV "
    "W kW MW Pa kPa MPa bar atm K C A mA V mV kV Ohm ohm F uF H mH T Hz kHz MHz rad mol L mph kph meter meters second "
    "seconds newton kelvin";

static bool unit(source *s, const span *at, const char *name)
{
    const struct source_text *t = &s->texts[at->text];
    const span number = foreign_before(s, at);
    if (number.from == number.to || !digit(t->bytes[number.from])) return false;
    char digits[SHOWN], all[SHOWN];
    source_excerpt(s, &number, digits, sizeof digits);
    if (listed("deg degree degrees", name)) {
        source_hint(s, "angles are in radians: write %s pi/180", digits);
        return true;
    }
    if (!listed(units, name)) return false;
    uint32_t to = at->from;
    while (to < t->length && (in_name(t->bytes[to]) || strchr("/^*", t->bytes[to]))) to++;
    source_excerpt(s, &(span){at->text, at->from, to}, all, sizeof all);
    source_hint(s, "a unit is no part of a number: write it in a comment, %s # %s; or define %s", digits, all, name);
    return true;
}

/* Hints at dU/dr, dU(r)/dr, d(…)/dr and d/dr(…), at the d or dU. */
static bool slope(source *s, const span *at, const char *name)
{
    const struct source_text *t = &s->texts[at->text];
    char of[SHOWN], by[SHOWN];
    uint32_t over = at->to, to;
    if (over < t->length && t->bytes[over] == '(') over = matching(t, over, 1) + 1;
    const bool bracket = over > at->to;
    if (name[0] != 'd' || over + 2 >= t->length || t->bytes[over] != '/' || t->bytes[over + 1] != 'd') return false;
    for (to = over + 2; to < t->length && in_name(t->bytes[to]);) to++;
    source_excerpt(s, &(span){at->text, over + 2, to}, by, sizeof by);
    if (!by[0]) return false;
    if (name[1] && !strcmp(by, "t")) {
        source_hint(s, "derivatives by the time are written with primes: %s'", name + 1);
    } else if (name[1]) {
        source_hint(s, "write diff(%s(%s), %s), where %s(%s) = … is a function", name + 1, by, by, name + 1, by);
    } else {
        const span behind = foreign_after(s, &(span){at->text, at->from, to}),
                   what = bracket ? (span){at->text, at->to, over} : behind;
        source_hint(s, "write diff(%s, %s)", trimmed(s, what.text, what.from, what.to, of), by);
    }
    return true;
}

bool foreign_name(source *s, const span *whole)
{
    const struct source_text *t = &s->texts[whole->text];
    char name[MOTUS_NAME_MAX + 1], a[SHOWN], b[SHOWN];
    span of = *whole, *const at = &of; /* without an index and primes */
    for (of.to = of.from; of.to < whole->to && in_name(t->bytes[of.to]);) of.to++;
    snprintf(name, sizeof name, "%.*s", (int)(at->to - at->from), t->bytes + at->from);
    if (unit(s, at, name) || slope(s, at, name)) return true;
    const span before = foreign_before(s, at), after = foreign_after(s, at);
    if ((!strcmp(name, "x") || !strcmp(name, "X")) && before.to > before.from && after.to > after.from) {
        source_hint(s, "the product of two vectors is written cross(%s, %s); or define %s",
                    trimmed(s, before.text, before.from, before.to, a), trimmed(s, after.text, after.from, after.to, b),
                    name);
        return true;
    }
    char lower[sizeof name];
    for (size_t i = 0; i < sizeof name; i++) lower[i] = small(name[i]);
    if (words_function(lower) >= 0 && at->to < t->length && t->bytes[at->to] == '[') {
        const span inside = {at->text, after.from + 1, after.to > after.from + 1 ? after.to - 1 : after.to};
        source_hint(s, "write %s(%s)", lower, source_excerpt(s, &inside, a, sizeof a));
        return true;
    }
    if (name[0] == '_' && digit(name[1]) && at->from > 0 && digit(t->bytes[at->from - 1])) {
        source_hint(s, "a number has no marks for thousands: write %s%s", source_excerpt(s, &before, a, sizeof a),
                    name + 1);
        return true;
    }
    const uint32_t end = before.to;
    if (!strcmp(name, "a") && end > 0 && (t->bytes[end - 1] == '*' || t->bytes[end - 1] == 'm')) { /* F = m a */
        source_hint(s, "an acceleration is written x'', and Newton's law m x'' = F; or define a");
        return true;
    }
    if (!strcmp(lower, "pi")) source_hint(s, "write pi");
    return !strcmp(lower, "pi");
}

/* Lines ------------------------------------------------------------------------------------------------------------ */

bool foreign_line(source *s, const span *at)
{
    const struct source_text *t = &s->texts[at->text];
    char name[MOTUS_NAME_MAX + 1], a[SHOWN];
    snprintf(name, sizeof name, "%.*s", (int)(at->to - at->from), t->bytes + at->from);
    const span after = foreign_after(s, at);
    source_excerpt(s, &after, a, sizeof a);
    if (listed("def function func fn lambda", name)) {
        source_hint(s, "a function is one line: f(t, y) = …");
    } else if (listed(
                   "let var const param parameter parameters real Real double float int integer constant state input",
                   name)) {
        source_hint(s, "a definition has no word before its name: %s = …", a[0] ? a : "k");
    } else if (listed("model begin end equation equations initial algorithm class system return", name)) {
        source_hint(s, "a model is a list of lines, without this word: x'' = -x");
    } else if (listed("plot print solve show draw run simulate integrate import include using save export output",
                      name)) {
        source_hint(s, "a model has no commands: who runs it says what is drawn and written");
    } else if (listed("stop while repeat loop event on at whenever trigger", name)) {
        source_hint(s, "what happens during a run is an event: when x < 0: stop");
    } else if (listed("dt h tstep timestep delta_t", name)) {
        source_hint(s, "the step of a method is written: step %s", after.to > after.from ? a : "0.1");
    } else if (listed("tmax tend t_max t_end tfinal T_end duration", name)) {
        source_hint(s, "the end of the run is written: until %s", after.to > after.from ? a : "10");
    } else if (listed("der ddt deriv derivative Derivative diff D Dt", name)) {
        uint32_t from = after.from + (after.to > after.from && t->bytes[after.from] == '('), to = from;
        while (to < after.to && in_name(t->bytes[to])) to++;
        source_excerpt(s, &(span){at->text, from, to}, a, sizeof a);
        source_hint(s, "derivatives are written with primes: %s' = …", a[0] ? a : "x");
    } else {
        return false;
    }
    return true;
}

/* Choices ---------------------------------------------------------------------------------------------------------- */

/* Finds a word in a part of a text; its end goes to *to. UINT32_MAX: it is not there. */
static uint32_t find(const struct source_text *t, uint32_t from, uint32_t end, const char *word, uint32_t *to)
{
    const uint32_t length = (uint32_t)strlen(word);
    for (uint32_t i = from; i + length <= end; i++) {
        const bool begins = i == 0 || !in_name(t->bytes[i - 1]) || !in_name(*word);
        const bool ends = i + length == end || !in_name(t->bytes[i + length]) || !in_name(*word);
        if (begins && ends && !memcmp(t->bytes + i, word, length)) return *to = i + length, i;
    }
    return UINT32_MAX;
}

void foreign_choice(source *s, const span *at)
{
    const struct source_text *t = &s->texts[at->text];
    uint32_t end = at->to, from = at->from, behind = 0, rest = 0;
    while (end < t->length && !strchr("\n;#", t->bytes[end])) end++;
    while (from > 0 && !strchr("\n;=", t->bytes[from - 1])) from--;
    uint32_t then = find(t, at->to, end, "then", &behind);
    if (then == UINT32_MAX) then = find(t, at->to, end, ":", &behind);
    const uint32_t other = find(t, then < end ? behind : at->to, end, "else", &rest), yes = other < end ? other : end;
    const span bracket = foreign_after(s, at);
    if (then == UINT32_MAX && bracket.to > bracket.from && t->bytes[bracket.from] == '(' && bracket.to < yes)
        then = behind = bracket.to; /* if (c) a else b */
    char a[SHOWN], b[SHOWN], c[SHOWN];
    source_hint(s, "write if(%s, %s, %s)", trimmed(s, at->text, at->to, then < end ? then : yes, a),
                then < end ? trimmed(s, at->text, behind, yes, b)
                           : trimmed(s, at->text, from, at->from, b), /* a if c else b */
                other < end ? trimmed(s, at->text, rest, end, c) : "…");
}
