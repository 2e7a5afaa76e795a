/* The lines of the bench: case, ours, other, ratio, limit, verdict, in columns that bench/chart.py reads again.
 *
 * Invariant: columns are two or more blanks apart, and no field holds two blanks in a row.
 */
#include "bench/bench.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

static FILE *second;
static int good, missed, unmeasured;

void report_open(FILE *copy) { second = copy; }

static void put(const char *format, va_list arguments)
{
    va_list again;
    va_copy(again, arguments);
    vprintf(format, arguments);
    fflush(stdout);
    if (second) vfprintf(second, format, again);
    va_end(again);
}

void report_text(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    put(format, arguments);
    va_end(arguments);
}

void report_note(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    report_text("      ");
    put(format, arguments);
    report_text("\n");
    va_end(arguments);
}

void report_section(const char *title, const char *what)
{
    report_text("\n%s\n%-58s  %9s  %9s  %7s  %8s\n", title, what, "ours", "other", "ratio", "limit");
}

static const char *figure(double value, const char *unit, char *out, size_t size)
{
    double scaled = !strcmp(unit, "ns") ? value * 1e9 : !strcmp(unit, "ms") ? value * 1e3 : value;
    if (isnan(value))
        snprintf(out, size, "-");
    else
        snprintf(out, size, "%.*f %s", scaled < 1 ? 3 : scaled < 10 ? 2 : scaled < 100 ? 1 : 0, scaled, unit);
    return out;
}

static void line(const char *name, double ours, double other, double value, const char *limit, int verdict,
                 const char *unit)
{
    char a[32], b[32], r[32];
    if (isnan(value))
        snprintf(r, sizeof r, "-");
    else
        snprintf(r, sizeof r, "%.*f", value < 0.1 ? 4 : value < 10 ? 2 : value < 100 ? 1 : 0, value);
    const char *word = verdict < 0 ? "" : isnan(value) ? "not measured" : verdict ? "ok" : "short";
    if (verdict >= 0) *(isnan(value) ? &unmeasured : verdict ? &good : &missed) += 1;
    report_text("  %-56s  %9s  %9s  %7s  %8s%s%s\n", name, figure(ours, unit, a, sizeof a),
                figure(other, unit, b, sizeof b), r, limit, *word ? "  " : "", word);
}

void report_at_most(const char *name, const side *ours, const side *other, double limit, const char *unit)
{
    char text[32];
    snprintf(text, sizeof text, "<= %.3g", limit);
    double value = ratio(ours, other);
    line(name, median(ours), median(other), value, text, value <= limit, unit);
}

void report_at_least(const char *name, const side *ours, const side *other, double limit, const char *unit)
{
    char text[32];
    snprintf(text, sizeof text, ">= %.3g", limit);
    double value = ratio(other, ours);
    line(name, median(ours), median(other), value, text, value >= limit, unit);
}

void report_times(const char *name, double ours, double other, double limit, const char *unit)
{
    char text[32];
    snprintf(text, sizeof text, ">= %.3g", limit);
    line(name, ours, other, other / ours, text, other / ours >= limit, unit);
}

void report_beside(const char *name, const side *ours, const side *other, const char *unit)
{
    line(name, ours ? median(ours) : NAN, median(other), ours ? ratio(ours, other) : NAN, "", -1, unit);
}

void report_value(const char *name, double value, double limit, const char *unit)
{
    char a[32], text[32];
    snprintf(text, sizeof text, "< %.3g", !strcmp(unit, "ms") ? limit * 1e3 : limit);
    const char *word = isnan(value) ? "not measured" : value < limit ? "ok" : "short";
    *(isnan(value) ? &unmeasured : value < limit ? &good : &missed) += 1;
    report_text("  %-56s  %9s  %9s  %7s  %8s  %s\n", name, figure(value, unit, a, sizeof a), "", "", text, word);
}

void report_error(const char *name, double ours, double other, double limit)
{
    char a[32], b[32], text[32];
    snprintf(a, sizeof a, "%.1e", ours);
    snprintf(b, sizeof b, "%.1e", other);
    snprintf(text, sizeof text, "<= %.2g", limit);
    const char *word = isnan(ours) ? "not measured" : ours <= limit ? "ok" : "short";
    *(isnan(ours) ? &unmeasured : ours <= limit ? &good : &missed) += 1;
    report_text("  %-56s  %9s  %9s  %7s  %8s  %s\n", name, a, b, "", text, word);
}

void report_bits(const char *name, bool known, bool same)
{
    *(!known ? &unmeasured : same ? &good : &missed) += 1;
    report_text("  %-56s  %9s  %9s  %7s  %8s  %s\n", name, "", "", "", "the same",
                !known ? "not measured"
                : same ? "ok"
                       : "short");
}

void report_close(void) { report_text("\n%d ok, %d short, %d not measured\n", good, missed, unmeasured); }
