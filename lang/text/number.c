/* Numbers from text. strtod follows the process's locale, whose decimal point may be a comma, so the point is
 * translated first. */
#include "lang/text/number.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *point(void)
{
    const char *p = localeconv()->decimal_point;
    return p && *p ? p : ".";
}

/* Numbers of more digits than this cannot round differently for what follows (767 significant digits decide every double; leading
 * zeros and a long tail are cut by the caller's grammar only through this bound). */
enum { DIGITS_MAX = 2000 };

bool number_read(const char *text, size_t length, double *value)
{
    char buffer[DIGITS_MAX + 64];
    size_t n = 0, i = 0;
    const char *p = point();
    bool seen_point = false;
    long dropped = 0;                /* integer digits cut: they scale the value */
    for (; i < length && (text[i] == '.' || (text[i] >= '0' && text[i] <= '9')); i++) {
        if (text[i] == '.') {
            seen_point = true;
            for (const char *q = p; *q; q++)
                buffer[n++] = *q;
        } else if (n < DIGITS_MAX) {
            buffer[n++] = text[i];
        } else if (!seen_point) {
            dropped++;
        }
    }
    long exponent = 0;
    if (i < length && (text[i] == 'e' || text[i] == 'E')) {
        bool minus = text[i + 1] == '-';
        for (i += 1 + (text[i + 1] == '-' || text[i + 1] == '+'); i < length; i++)
            if (exponent < 100000000)
                exponent = exponent * 10 + (text[i] - '0');
        if (minus)
            exponent = -exponent;
    }
    snprintf(buffer + n, sizeof buffer - n, "e%ld", exponent + dropped);
    *value = strtod(buffer, NULL);
    return isfinite(*value);
}
