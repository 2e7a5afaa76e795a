/* make bench: what motus takes, beside the best that was written by hand for one problem, and beside what one would
 * pick instead.
 *
 *     bench [--save DIRECTORY] [accuracy] [ensembles] [energy] [events] [single] [large] [programs] [sweeps]
 *
 * Run it where models/ and bench/ are. It never fails because of a figure; "short" says that a limit was missed.
 * --save writes the lines to DIRECTORY/<machine>.txt as well, and prints that name last.
 */
#include "bench/bench.h"

#include <string.h>

int main(int count, char **words)
{
    /* Programs first: what a program is charged for begins with the memory of the process that starts it. */
    static const struct {
        const char *name;
        void (*run)(void);
    } parts[] = {{"programs", compare_programs}, {"ensembles", compare_ensembles}, {"single", compare_single},
                 {"large", compare_large},       {"accuracy", compare_accuracy},   {"energy", compare_energy},
                 {"events", compare_events},     {"sweeps", compare_sweeps}};
    enum { PARTS = sizeof parts / sizeof *parts };
    const char *directory = NULL;
    char file[512] = "";
    bool wanted[PARTS] = {false}, all = true;
    for (int k = 1; k < count; k++) {
        bool known = false;
        if (!strcmp(words[k], "--save") && k + 1 < count)
            directory = words[++k], known = true;
        else
            for (int p = 0; p < PARTS; p++)
                if (!strcmp(words[k], parts[p].name)) wanted[p] = known = true, all = false;
        if (!known) {
            fprintf(stderr,
                    "bench: \"%s\" is none of accuracy, ensembles, energy, events, single, large, programs, sweeps, "
                    "--save DIRECTORY\n",
                    words[k]);
            return 2;
        }
    }
    FILE *copy = NULL;
    if (directory) {
        char name[200];
        machine_slug(name, sizeof name);
        snprintf(file, sizeof file, "%s/%s.txt", directory, name);
        if (!(copy = fopen(file, "w"))) {
            fprintf(stderr, "bench: %s cannot be written\n", file);
            return 2;
        }
    }
    if (!process_open()) fprintf(stderr, "bench: no directory for a cache of its own\n");
    report_open(copy);
    machine_describe();
    for (int p = 0; p < PARTS; p++)
        if (all || wanted[p]) parts[p].run();
    report_close();
    process_close();
    if (copy) fclose(copy), printf("%s\n", file);
    return 0;
}
