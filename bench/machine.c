/* What was measured on: the processor and the tools, and nothing that would name a computer or its user. */
#include "bench/bench.h"
#include "bench/hand/hand.h"
#include "motus.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

int machine_cores(void)
{
    long n = sysconf(_SC_NPROCESSORS_ONLN);
    return n > 0 ? (int)n : 1;
}

/* The value of the first line of a file that begins with `key`, after its colon (or equals sign). */
static bool value_of(const char *file, const char *key, char *out, size_t size)
{
    char text[512];
    bool found = false;
    FILE *f = fopen(file, "r");
    while (f && !found && fgets(text, sizeof text, f))
        if (!strncmp(text, key, strlen(key))) {
            const char *value = strpbrk(text, ":=");
            if (!value) continue;
            value += 1 + strspn(value + 1, " \t\"");
            snprintf(out, size, "%.*s", (int)strcspn(value, "\"\n"), value);
            found = true;
        }
    if (f) fclose(f);
    return found;
}

static void processor(char *out, size_t size)
{
    char family[32] = "", model[32] = "";
    char name[200];
    if (!value_of("/proc/cpuinfo", "model name", name, sizeof name)) {
        struct utsname u;
        snprintf(name, sizeof name, "%s", uname(&u) ? "unknown processor" : u.machine);
    }
    if (value_of("/proc/cpuinfo", "cpu family", family, sizeof family) &&
        value_of("/proc/cpuinfo", "model\t", model, sizeof model))
        snprintf(out, size, "%s (family %s, model %s)", name, family, model);
    else
        snprintf(out, size, "%s", name);
}

void machine_describe(void)
{
    char cpu[300], os[200] = "unknown system", cache[64] = "?";
    struct utsname u = {0};
    processor(cpu, sizeof cpu);
    value_of("/etc/os-release", "PRETTY_NAME", os, sizeof os);
    value_of("/proc/cpuinfo", "cache size", cache, sizeof cache);
    uname(&u);
    report_text("motus %s on %s, %d cores, second cache %s, %s\n", motus_version(), cpu, machine_cores(), cache,
                hand_lanes());
    double load[1] = {0};
    (void)!getloadavg(load, 1);
    report_text("%s, %s %.*s, load %.1f before the start, compiled by "
#ifdef __clang__
                "clang "
#else
                "gcc "
#endif
                __VERSION__ "\n",
                os, u.sysname, (int)strcspn(u.release, "-+"), u.release, load[0]);
}

void machine_slug(char *out, size_t size)
{
    char text[400];
    processor(text, sizeof text);
    strncat(text, "-", sizeof text - strlen(text) - 1);
    strncat(text, hand_lanes(), sizeof text - strlen(text) - 1);
    size_t n = 0;
    for (const char *p = text; *p && n + 1 < size; p++) {
        if (isalnum((unsigned char)*p))
            out[n++] = (char)tolower((unsigned char)*p);
        else if (n && out[n - 1] != '-')
            out[n++] = '-';
    }
    out[n] = 0;
}
