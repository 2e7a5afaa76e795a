/* See bar.h.
 *
 * Invariant: the printed value lies within the printed error of all that lies within `error` of `value`.
 */
#include "tell/bar.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TINIEST = -300 }; /* of smaller powers of ten not all digits exist */

/* Returns the power of ten of the first digit. */
static int power_of(double number)
{
    char text[DECIMAL_MAX];
    snprintf(text, sizeof text, "%.0e", number);
    const int rounded = atoi(strchr(text, 'e') + 1);
    /* 9.9 prints as 1e1 */
    return number < decimal_scaled(1, rounded) ? rounded - 1 : rounded;
}

/* Writes digits × 10^power: "1.5e-6", "0.03", "200". */
static void error_text(int digits, int power, char out[DECIMAL_MAX])
{
    const int first = power + (digits >= 10);
    if (first >= -3 && first < 3)
        snprintf(out, DECIMAL_MAX, "%.*f", power < 0 ? -power : 0, decimal_scaled(digits, power));
    else if (digits >= 10)
        snprintf(out, DECIMAL_MAX, "%d.%de%d", digits / 10, digits % 10, first);
    else
        snprintf(out, DECIMAL_MAX, "%de%d", digits, first);
}

/* Takes the plus and the zeros out of an exponent: 1.5e+07 becomes 1.5e7. */
static void tidy(char *number)
{
    char *e = strchr(number, 'e');
    if (e) snprintf(e + 1, DECIMAL_MAX - (size_t)(e + 1 - number), "%d", atoi(e + 1));
}

/* Writes the value to the decimal 10^power. */
static void value_text(double value, int power, char out[DECIMAL_MAX])
{
    const int first = power_of(fabs(value)), digits = first > power ? first - power : 0;
    const bool plain = first >= -5 && first < 15;
    if (plain && power <= 0) {
        snprintf(out, DECIMAL_MAX, "%.*f", -power, value);
        return;
    }
    snprintf(out, DECIMAL_MAX, "%.*e", digits, value);
    if (!plain) {
        tidy(out);
        return;
    }
    double whole = 0; /* digits and zeros are a whole number, and a double */
    decimal_read(out + (value < 0), SIZE_MAX, &whole);
    snprintf(out, DECIMAL_MAX, "%.0f", value < 0 ? -whole : whole);
}

/* Returns how many 10^power are at least `error` and what rounding the value to one of them takes. */
static int units(double error, int power, double rounding)
{
    return (int)ceil(error / decimal_scaled(1, power) * (1 + 0x1p-50) + rounding);
}

/* Finds the power of ten to which an error is rounded up, and returns how many of them it takes. */
static int round_up(double error, double rounding, int *power)
{
    *power = power_of(error);
    if (error < 3 * decimal_scaled(1, *power)) --*power;
    const int digits = units(error, *power, rounding);
    return digits < 30 ? digits : units(error, ++*power, rounding);
}

char *bar_error(double error, char out[DECIMAL_MAX])
{
    int power;
    if (!(error > 0) || !isfinite(error) || power_of(error) < TINIEST) return decimal(error, out);
    const int digits = round_up(error, 0, &power);
    error_text(digits, power, out);
    return out;
}

char *bar_text(double value, double error, char out[BAR_MAX])
{
    char number[DECIMAL_MAX], bar[DECIMAL_MAX];
    if (isinf(error)) return strcpy(out, "—");
    if (isnan(value)) return strcpy(out, "undefined");
    decimal(value == 0 ? 0 : value, number); /* no -0 */
    if (error == 0 || isnan(error) || !isfinite(value)) {
        snprintf(out, BAR_MAX, "%s%s", number, error == 0 ? value == 0 ? " (exact)" : "" : " ±?");
        return out;
    }
    const bool zero = fabs(value) <= error;
    const double whole = zero ? fabs(value) + error : error, rounding = zero ? 0 : 0.5;
    int power;
    if (power_of(whole) < TINIEST) return snprintf(out, BAR_MAX, "%s ± %.0e", zero ? "0" : number, whole), out;
    const int digits = round_up(whole, rounding, &power);
    error_text(digits, power, bar);
    if (zero)
        snprintf(number, sizeof number, "0");
    else
        value_text(value, power, number);
    snprintf(out, BAR_MAX, "%s ± %s", number, bar);
    return out;
}

char *bar_digits(double value, double error, char out[BAR_MAX])
{
    char number[DECIMAL_MAX];
    const bool told = error > 0 && isfinite(error) && isfinite(value) && fabs(value) > error;
    if (!told || power_of(error) < TINIEST) return bar_text(value, error, out);
    int power;
    const int digits = round_up(error, 0.5, &power);
    if (power > 0) return bar_text(value, error, out);
    value_text(value, power, number);
    const size_t length = strcspn(number, "e");
    snprintf(out, BAR_MAX, "%.*s(%d)%s", (int)length, number, digits, number + length);
    return out;
}
