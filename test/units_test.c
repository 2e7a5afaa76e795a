/* Units in comments: what is one, and what only begins like one. */
#include "cli/model/load.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void reads(const char *comment, const char *unit)
{
    char out[UNIT_MAX] = "";
    bool alone;
    const bool found = units_read(comment, out, &alone);
    if (!unit && found) fail_msg("\"%s\" is no unit, and reads as \"%s\"", comment, out);
    if (unit && (!found || strcmp(out, unit) != 0))
        fail_msg("\"%s\" has the unit %s, and reads as \"%s\"", comment, unit, out);
}

static void test_units(void **context)
{
    (void)context;
    static const char *const units[][2] = {
        {"m", "m"},
        {"# m/s^2", "m/s^2"},
        {"[km/s]", "km/s"},
        {"m/s, upwards", "m/s"},
        {"mm^2/(ns^2 V), charge over mass", "mm^2/(ns^2 V)"},
        {"mT = V ns/mm^2", "mT"},
        {"1/s", "1/s"},
        {"N/m: stiffness", "N/m"},
        {"au, half the long axis", "au"},
        {"kg m^2/s", "kg m^2/s"},
        {"m² s⁻¹", "m² s⁻¹"},
        {"µm (above the plate)", "µm"},
        {"years", "years"},
        {"masses, in kg", "kg"},
        {"°", "°"},
        {"J/(kg*K)", "J/(kg*K)"},
        {"m^(1/2)", "m^(1/2)"},
        {"rad/s. Fast.", "rad/s"},
    };
    for (size_t k = 0; k < sizeof units / sizeof *units; k++) reads(units[k][0], units[k][1]);
    static const char *const others[] = {
        "",
        "mass",
        "stiffness",
        "G times the mass of the sun",
        "a quantity: it is lost",
        "s of force",
        "m is heavy",
        "of a kick",
        "the part of the speed",
        "J/kg or so",
        "m/",
        "1",
        "g of the Earth",
        "in units of what the spring pulls with",
        "m^",
        "(m",
        "in s, as usual",
        "as before",
        "1/1.3e8",
        "friction",
        "T/2000",
        "seconds to go",
        "m/s^x",
    };
    for (size_t k = 0; k < sizeof others / sizeof *others; k++) reads(others[k], NULL);
}

static void named(const char *model, const char *name, bool time, const char *unit)
{
    char out[UNIT_MAX];
    units_of(model, name, time, out);
    assert_string_equal(out, unit);
}

static void test_names(void **context)
{
    (void)context;
    static const char model[] = "A = 2                  # V\n"
                                "k = 3                  # A, the same as above\n"
                                "l = 3                  # N, of the spring\n"
                                "r'' = -k r             # m/s^2\n"
                                "r(0) = (1, 0); q(0) = 1 # kg\n"
                                "x(0) = A               # m\n"
                                "x'(0) = 1              # m/s: fast\n"
                                "z(0) = 1               # km\n"
                                "z'(0) = 1              # as much\n"
                                "u(0) = 1\n"
                                "invariant energy = x^2 # J\n"
                                "untilted = 4           # kg\n"
                                "step 0.1               # nine of them\n"
                                "until 60               # s, a minute\n";
    named(model, "x", false, "m");
    named(model, "x'", false, "m/s");
    named(model, "max(x)", false, "m");
    named(model, "z'", false, "km/s"); /* that of z over that of the time */
    named(model, "u'", false, "");
    named(model, "x(0)", false, "m");
    named(model, "energy", false, "J");
    named(model, "t", true, "s");
    named(model, "until", false, "s");
    named(model, "l", false, "N");
    named(model, "k", false, ""); /* A is a parameter here */
    named(model, "A", false, "V");
    named(model, "r", false, "");
    named(model, "q", false, "");
    named(model, "y", false, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_units), cmocka_unit_test(test_names)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
