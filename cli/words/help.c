/* The text of --help: what a verb does, its options, and examples, which the tests run. */
#include "cli/words/options.h"
#include "cli/words/text.h"

typedef struct page {
    unsigned verb;
    const char *about, *examples;
} page;

static const page pages[] = {
    {VERB_RUN,
     "Integrates a model and prints the state at the end, each number with its error, and the drift of the "
     "invariants.\nMODEL is a file, or - for standard input.",
     "  motus run models/driven-oscillator.motus\n"
     "  motus run models/pendulum.motus --method rk4 --step 1/64 --until 20\n"
     "  motus run models/spring.motus -o traj.csv --every 0.1 --columns \"t,x,x'\"\n"
     "  motus run models/damped-cubic.motus --plot phase.svg --plot-of \"x,x'\"\n"
     "  motus run models/henon-heiles.motus --until 5000 --section \"x = 0 rising\" \\\n"
     "      --plot section.svg\n"
     "  motus run models/kepler.motus --save-state half.state --until 10\n"
     "  motus run models/kepler.motus --restart half.state --until 20\n"
     "  motus run models/kepler.motus --until 10 -o kepler.h5\n"
     "  motus run kepler.h5 --until 20\n"
     "  printf \"x'' = -x\\nx(0) = 1\\nx'(0) = 0\\n\" | motus run - --step 0.01 --until 10\n"
     "  motus run models/pendulum.motus --set \"theta(0)=3\" --step 1/64 --share\n"},
    {VERB_COMPARE,
     "Runs every method and prints for each: steps, evaluations, time, the largest and the final error against "
     "the exact motion or a reference solution, the drift of the invariants and its trend, and the reversal "
     "error: the distance from the start after a run to the end and back.",
     "  motus compare models/projectile.motus\n"
     "  motus compare models/spring.motus \\\n"
     "      --methods explicit-euler,symplectic-euler,verlet --plot spring.svg\n"
     "  motus compare models/kepler.motus --evaluations 20000\n"
     "  motus compare models/kepler.motus --accuracies 1e-3:1e-11 \\\n"
     "      --methods verlet,dop853,dep12 --plot work.svg\n"},
    {VERB_CONVERGE,
     "Measures the order of every method on this model: errors at a sequence of steps, their slope between "
     "instability and round-off, and the certificate. Exit status 1 if a method does not show its declared "
     "order.",
     "  motus converge models/pendulum.motus\n"
     "  motus converge models/damped-cubic.motus --methods verlet,rk4 \\\n"
     "      --plot orders.svg\n"
     "  motus converge models/charged-particle.motus --json\n"},
    {VERB_SWEEP,
     "Integrates a model many times, on all processors, with different parameters, initial values or ends, and "
     "writes a row for each trajectory. Two --vary combine every value of one with every value of the other. "
     "--resume continues a sweep that was interrupted, even by kill -9.",
     "  motus sweep models/driven-oscillator.motus --vary F=0:0.2:11\n"
     "  motus sweep models/pendulum.motus --vary \"theta(0)=0:pi:181\" \\\n"
     "      --record \"max(theta),final\" --until 10 -o swings.csv\n"
     "  motus sweep models/driven-oscillator.motus --vary F=log:0.001:0.1:3 \\\n"
     "      --vary \"x(0)=0,0.1,0.2\" --record \"x,max(x)\"\n"
     "  motus sweep models/kepler.motus --random \"r'.y(0)=normal:2:0.01\" \\\n"
     "      --count 1000 --seed 7 --until 20 -o cloud.npy\n"
     "  motus sweep models/pendulum.motus --vary \"theta(0)=@swings.csv:theta(0)\" \\\n"
     "      --until 1 --record energy\n"},
    {VERB_MERGE,
     "Joins the files of all shards of a sweep, in any order, to the file that one sweep writes, byte for byte: "
     "rows or events as CSV, .npy or .h5.",
     "  motus sweep models/pendulum.motus --vary \"theta(0)=0:pi:9001\" --until 10 \\\n"
     "      --shard 1/2 -o part%K.csv\n"
     "  motus sweep models/pendulum.motus --vary \"theta(0)=0:pi:9001\" --until 10 \\\n"
     "      --shard 2/2 -o part%K.csv\n"
     "  motus merge part1.csv part2.csv -o swings-all.csv\n"},
    {VERB_ARCHIVE,
     "Prints what an archive contains, and whether all of its blocks are there and match their hashes. With -o "
     "it writes the rows as CSV, the model, or the state of a run.",
     "  motus archive swings.h5\n"
     "  motus archive swings.h5 -o swings.csv\n"
     "  motus archive swings.h5 -o pendulum.motus\n"
     "  motus archive swings.h5 --verify 10%\n"},
    {VERB_CHECK,
     "Prints the equations of a model as motus read them, what the acceleration depends on, and for every "
     "method whether the model admits it, and if not, why.",
     "  motus check models/damped-cubic.motus\n"
     "  motus check models/charged-particle.motus --json\n"},
    {VERB_LAB,
     "Writes the page of the lab with the model in it, one file that needs no network, and opens it in the "
     "browser ($BROWSER, else the system's). The file is NAME-lab.html in the current folder, where NAME is the "
     "model's; its path goes to standard output.",
     "  motus lab\n"
     "  motus lab models/pendulum.motus --set \"theta(0)=3\"\n"
     "  motus lab models/spring.motus --method verlet \\\n"
     "      --methods explicit-euler,symplectic-euler --step 1/8\n"
     "  motus lab models/kepler.motus --no-open -o lesson.html\n"},
    {VERB_METHODS, "Lists the methods, or shows the card of one: formula, properties, reference, when to use it.",
     "  motus methods\n"
     "  motus methods verlet\n"
     "  motus methods --json\n"},
    {VERB_CACHE,
     "The compiled machine keeps compiled models in $XDG_CACHE_HOME/motus (default: ~/.cache/motus). This "
     "removes them; motus compiles a model again when it needs it.",
     "  motus cache --clear\n"},
};

static const struct {
    const char *name, *operands, *about;
} verbs[] = {
#define VERB(bit, name, ...) {#name, __VA_ARGS__},
#include "cli/words/options.def"
};

void help_program(FILE *out)
{
    fputs("motus: type an equation of motion, get the motion\n\n", out);
    table *t = table_create("ll");
    for (size_t k = 0; k < VERB_COUNT; k++) {
        char left[128];
        snprintf(left, sizeof left, "motus %s %s", verbs[k].name, verbs[k].operands);
        table_cell(t, left);
        table_cell(t, verbs[k].about);
    }
    (void)table_print(t, out, 2, false);
    table_destroy(t);
    fputs("\n"
          "  motus VERB --help              options and examples;  motus --version\n\n"
          "A model is a text that reads like a textbook:\n\n"
          "  x''   = -x + x^3 + 0.1 cos(t)\n"
          "  x(0)  = 0\n"
          "  x'(0) = 0\n"
          "  method verlet\n"
          "  step   0.001\n"
          "  until  100\n\n",
          out);
    text_wrap(
        out,
        "Data goes to standard output, messages to standard error. Exit status: 0 done, 1 the computation failed, 2 "
        "the request was wrong. Ctrl-C ends the program by its signal and leaves no incomplete file; a sweep keeps "
        "its complete rows, and --resume continues it.",
        0);
}

static void put_options(FILE *out, unsigned verb)
{
    char left[40], help[OPTIONS_HELP];
    table *t = table_create("ll");
    for (size_t k = 0; k < OPTION_COUNT; k++) {
        const option *o = options_row(k);
        if (!(o->verbs & verb)) continue;
        snprintf(left, sizeof left, "%s%s%s%s%s", o->brief ? o->brief : "", o->brief ? ", " : "", o->name,
                 o->argument ? " " : "", o->argument ? o->argument : "");
        table_cell(t, left);
        table_cell(t, options_plain(o->help, help));
    }
    (void)table_print(t, out, 2, false);
    table_destroy(t);
}

void help_verb(FILE *out, unsigned verb)
{
    for (size_t k = 0; k < VERB_COUNT; k++)
        if (verb == 1u << k) fprintf(out, "motus %s %s [options]\n\n", verbs[k].name, verbs[k].operands);
    for (size_t i = 0; i < sizeof pages / sizeof *pages; i++)
        if (pages[i].verb == verb) {
            text_wrap(out, pages[i].about, 0);
            fputs("\noptions:\n", out);
            put_options(out, verb);
            fprintf(out, "\nexamples:\n%s", pages[i].examples);
        }
}

static const char *setting(unsigned of)
{
    return of == OF_MOTION    ? "motion"
           : of == OF_ROWS    ? "rows"
           : of == OF_FILES   ? "files"
           : of == OF_MACHINE ? "machine"
                              : "another";
}

void help_table(FILE *out)
{
    for (size_t k = 0; k < VERB_COUNT; k++)
        fprintf(out, "verb\t%s\t%s\t%s\n", verbs[k].name, verbs[k].operands, verbs[k].about);
    for (size_t k = 0; k < OPTION_COUNT; k++) {
        const option *o = options_row(k);
        fprintf(out, "option\t%s\t%s\t%s\t", o->name, o->brief ? o->brief : "-", o->argument ? o->argument : "-");
        for (size_t v = 0, some = 0; v < VERB_COUNT; v++)
            if (o->verbs & 1u << v) fprintf(out, "%s%s", some++ ? "," : "", verbs[v].name);
        fprintf(out, "\t%s\t%s\t%s\t%s\n", setting(o->setting), o->choices ? o->choices : "-", o->help,
                o->more ? o->more : "");
    }
}
