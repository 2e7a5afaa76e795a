/* motus sweep --plan: what the sweep would take, from a sample that is computed and measured.
 *
 * The pieces of the sample are spread over the sweep, because trajectories with different values may take different
 * work. The differences of the pieces give the error of the mean. A piece is as large as a batch of the sweep, since
 * smaller pieces would leave more lanes idle. No file is touched.
 */
#include "cli/files/stop.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"
#include "cli/words/text.h"

#include <math.h>
#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

enum { LEAST_PIECES = 8, PIECES = 4096, MOST_RANKS = 4096, SAMPLE_S = 60, WARM_S = 20 };
#define PART 1e-4 /* the least part of the sweep that is a sample */

typedef struct plan {
    const sweep *sweep;
    sweep_batch batch;
    sweep_file text;            /* a CSV that is not kept; if its buffer is NULL, no CSV is wanted */
    size_t piece, pieces;       /* the trajectories in a piece; the pieces that were measured */
    uint64_t sampled;           /* the trajectories that were measured */
    double spent, each[PIECES]; /* seconds: of all pieces, and for a trajectory of each piece */
    double mean, error;         /* seconds for a trajectory, and their error */
    double bytes;               /* of the file */
    double ended;               /* the part of the trajectories that stopped */
    double memory;              /* bytes of a process */
} plan;

/* ---- measuring ---- */

static bool waits_for_compiler(const sweep *s)
{
    const motus_ensemble_statistics now = motus_ensemble_now(s->ensemble);
    return now.compiled_from == -1 && !now.note[0] &&
           (!s->options->machine || strcmp(s->options->machine, "auto") == 0);
}

/* Returns where piece k begins. The multiples of the golden section are spread evenly, however many there are. */
static uint64_t place_of(const plan *p, size_t k)
{
    const double golden = 0.6180339887498949, part = fmod(((double)k + 0.5) * golden, 1);
    const uint64_t last = p->sweep->rows - p->piece;
    const uint64_t at = (uint64_t)(part * ((double)last + 1));
    return at < last ? at : last;
}

/* Computes piece k, and writes it if a CSV is wanted, since writing its numbers takes time too. */
static motus_status one(plan *p, size_t k, double *seconds, motus_error *err)
{
    const double began = stop_clock();
    p->text.rows = place_of(p, k);
    motus_status status = sweep_batch_compute(&p->batch, p->sweep, p->text.rows, p->piece, NULL, err);
    if (status == MOTUS_ACCURACY) status = MOTUS_OK; /* the sweep itself will report it */
    const sweep_rows rows = sweep_batch_rows(&p->batch);
    if (!status && p->text.buffer) status = sweep_file_rows(&p->text, p->piece, &rows, err);
    *seconds = stop_clock() - began;
    return status;
}

/* Waits for the compiled machine, which is faster, unless the sweep would be over before; and lets pieces become as
 * large as the batches of the sweep. */
static motus_status warm_up(plan *p, motus_error *err)
{
    motus_status status = MOTUS_OK;
    const uint64_t rows = p->sweep->rows;
    const double began = stop_clock();
    double seconds, most = WARM_S;
    for (size_t k = 0; !status && stop_clock() - began < most; k++) {
        p->piece = p->batch.count < rows ? p->batch.count : (size_t)rows;
        status = one(p, k, &seconds, err);
        sweep_batch_adapt(&p->batch, p->sweep, seconds);
        const double all = seconds * (double)rows / (double)p->piece;
        const bool grows = p->piece < rows && p->batch.count > p->piece + p->piece / 2;
        most = grows ? WARM_S : waits_for_compiler(p->sweep) ? fmin(all, WARM_S) : 0;
        if (!status && stop_requested()) status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    return status;
}

static void count_stopped(plan *p)
{
    for (size_t i = 0; i < p->piece; i++) p->ended += !isnan(p->batch.stopped[i]);
}

/* Returns twice the standard error of the mean. */
static double error_of(const plan *p)
{
    const double n = (double)p->pieces;
    double square = 0;
    if (p->pieces < 2) return NAN;
    for (size_t k = 0; k < p->pieces; k++) square += (p->each[k] - p->mean) * (p->each[k] - p->mean);
    return 2 * sqrt(square / (n - 1) / n);
}

static bool enough(const plan *p)
{
    const double rows = (double)p->sweep->rows;
    if (p->sampled + p->piece > p->sweep->rows || p->pieces == PIECES || p->spent > SAMPLE_S) return true;
    return p->pieces >= LEAST_PIECES && (double)p->sampled >= PART * rows;
}

static motus_status sample(plan *p, stop_progress *progress, motus_error *err)
{
    motus_status status = warm_up(p, err);
    const uint64_t before = p->text.bytes;
    while (!status && (p->pieces == 0 || !enough(p))) {
        double seconds;
        status = one(p, p->pieces, &seconds, err);
        if (!status && stop_progress_hook(progress, 1)) status = fail(err, MOTUS_CANCELLED, "cancelled");
        if (status) break;
        count_stopped(p);
        p->spent += seconds;
        p->sampled += p->piece;
        p->each[p->pieces++] = seconds / (double)p->piece;
        p->mean = p->spent / (double)p->sampled;
    }
    p->error = error_of(p);
    p->ended /= (double)p->sampled;
    if (p->text.buffer) p->bytes = (double)(p->text.bytes - before) / (double)p->sampled * (double)p->sweep->rows;
    return status;
}

/* ---- estimates ---- */

static uint64_t blocks_of(const sweep *s) { return shard_blocks(&s->shard, s->rows); }

static double pages(double bytes) { return ceil(bytes / 4096) * 4096; }

/* Returns the bytes of a .npy or an archive, which follow from the number of rows. */
static double bytes_of_file(const sweep *s)
{
    const double rows = (double)s->rows, numbers = (double)s->columns;
    if (!target_archive(s->options->output)) return SWEEP_NPY_HEAD + rows * numbers * sizeof(double);
    double columns = 0;
    for (size_t k = 0; k < s->columns; k++) /* column 0 is the number of the trajectory */
        columns += pages(rows * (k == s->columns - 1 || k == sweep_ended(s) ? 1 : sizeof(double)));
    return columns + pages(8 * (double)blocks_of(s));
}

/* Estimates the memory of a process: what it has now, and what it does not use yet. */
static double memory_of(const plan *p)
{
    enum { FILL = 2 << 20 }; /* for making an archive */
    struct rusage usage;
    const sweep *s = p->sweep;
    const bool archive = s->options->output && target_archive(s->options->output);
    const double blocks = (double)blocks_of(s), room = (double)(s->columns * s->shard.block * sizeof(double));
    if (archive) (void)motus_archive_makes(); /* loads the libraries of archives */
    getrusage(RUSAGE_SELF, &usage);
    return (archive ? FILL : 0) + (double)usage.ru_maxrss * 1024 + (double)sweep_batch_bytes(&p->batch, s) + room +
           8 * blocks;
}

/* Returns the seconds that `ranks` processes take, each with our number of threads. A process has at least a block. */
static double seconds_by(const plan *p, int ranks)
{
    const double rows = (double)p->sweep->rows;
    return p->mean * fmax(rows / ranks, fmin(rows, (double)p->sweep->shard.block));
}

/* ---- the report ---- */

static const char *size_text(double bytes, char out[DECIMAL_MAX])
{
    static const char *const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB"};
    size_t k = 0;
    for (; bytes >= 999.5 && k + 1 < sizeof units / sizeof *units; k++) bytes /= 1000;
    snprintf(out, DECIMAL_MAX, "%.3g %s", bytes, units[k]);
    return out;
}

static void report_json(const plan *p)
{
    const sweep *s = p->sweep;
    char shard[SHARD_TEXT];
    const motus_ensemble_statistics now = motus_ensemble_now(s->ensemble);
    json j = text_json(stdout);
    json_string(&j, "model", s->options->operand);
    json_string(&j, "method", s->method);
    json_integer(&j, "trajectories", (int64_t)s->rows);
    json_string(&j, "shard", shard_whole(&s->shard) ? NULL : shard_text(&s->shard, shard));
    json_integer(&j, "blocks", (int64_t)blocks_of(s));
    json_integer(&j, "block", (int64_t)s->shard.block);
    json_integer(&j, "steps", now.steps);
    json_string(&j, "machine", now.machine);
    json_integer(&j, "lanes", now.lanes);
    json_integer(&j, "threads", now.threads);
    json_integer(&j, "columns", (int64_t)s->columns);
    json_number(&j, "bytes", p->bytes);
    json_number(&j, "memory", p->memory);
    json_open(&j, "sample", '{');
    json_integer(&j, "trajectories", (int64_t)p->sampled);
    json_integer(&j, "pieces", (int64_t)p->pieces);
    json_number(&j, "seconds", p->spent);
    json_number(&j, "each", p->mean);
    json_number(&j, "error", p->error);
    json_number(&j, "stopped", p->ended);
    json_close(&j, '}');
    json_open(&j, "ranks", '[');
    for (int ranks = 1; ranks <= MOST_RANKS; ranks *= 2) {
        json_open(&j, NULL, '{');
        json_integer(&j, "ranks", ranks);
        json_number(&j, "hours", seconds_by(p, ranks) / 3600);
        json_close(&j, '}');
    }
    json_close(&j, ']');
    json_string(&j, "output", s->options->output);
    json_end(&j);
}

static void put_file(const plan *p)
{
    char text[DECIMAL_MAX];
    const char *path = p->sweep->options->output;
    printf("  file     ");
    text_put(stdout, path ? path : "-");
    printf(", %zu columns, %s%s\n", p->sweep->columns, p->text.buffer ? "about " : "", size_text(p->bytes, text));
}

static const char *duration(double seconds, char out[DECIMAL_MAX])
{
    const bool hours = seconds >= 3600, minutes = seconds >= 60;
    snprintf(out, DECIMAL_MAX, "%.3g %s",
             seconds / (hours     ? 3600
                        : minutes ? 60
                                  : 1),
             hours     ? "h"
             : minutes ? "min"
                       : "s");
    return out;
}

static void put_ranks(const plan *p)
{
    char text[DECIMAL_MAX], time[DECIMAL_MAX];
    const uint64_t blocks = blocks_of(p->sweep);
    printf("\n  %7s  %10s  %12s\n", "ranks", "time", "written");
    for (int ranks = 1; ranks <= MOST_RANKS; ranks *= 2) {
        const double seconds = seconds_by(p, ranks);
        printf("  %7d  %10s  %10s/s\n", ranks, duration(seconds, time), size_text(p->bytes / seconds, text));
        if ((uint64_t)ranks >= blocks) {
            printf("  more than %llu ranks have nothing to do: there are no more blocks\n", (unsigned long long)blocks);
            break;
        }
    }
}

static void report(const plan *p)
{
    const sweep *s = p->sweep;
    char text[DECIMAL_MAX], spent[DECIMAL_MAX];
    const motus_ensemble_statistics now = motus_ensemble_now(s->ensemble);
    printf("%s: %s, ", s->model.title, s->method);
    if (now.steps > 0) printf("%lld step%s, ", (long long)now.steps, now.steps == 1 ? "" : "s");
    printf("%s, %d lane%s, %d thread%s\n", now.machine, now.lanes, now.lanes == 1 ? "" : "s", now.threads,
           now.threads == 1 ? "" : "s");
    printf("%llu trajectories, in %llu block%s of %llu\n\n", (unsigned long long)s->rows,
           (unsigned long long)blocks_of(s), blocks_of(s) == 1 ? "" : "s", (unsigned long long)s->shard.block);
    put_file(p);
    printf("  memory   about %s for each rank\n", size_text(p->memory, text));
    text_seconds(p->mean, text);
    text_seconds(p->spent, spent);
    printf("  sample   %llu trajectories in %zu piece%s, %s: %s each", (unsigned long long)p->sampled, p->pieces,
           p->pieces == 1 ? "" : "s", spent, text);
    if (!isnan(p->error)) printf(" (\u00b1 %.2g %%)", 100 * p->error / p->mean);
    putchar('\n');
    if (p->ended > 0) printf("           %.3g %% of them stop before their end\n", 100 * p->ended);
    put_ranks(p);
    printf("\na rank has %d thread%s here; the times do not include the disk\n", now.threads,
           now.threads == 1 ? "" : "s");
}

/* Opens /dev/null for the rows of a CSV, if one is wanted. */
static motus_status open_text(plan *p, sweep *of, options *o, motus_error *err)
{
    const char *path = p->sweep->options->output;
    if (path && (target_npy(path) || target_archive(path))) return MOTUS_OK;
    *o = *p->sweep->options, *of = *p->sweep;
    o->output = "/dev/null", o->resume = false, o->team = NULL;
    of->options = o;
    return sweep_file_open(&p->text, of, err);
}

motus_status sweep_plan(const sweep *s, stop_progress *progress, motus_error *err)
{
    if (s->rows == 0)
        return fail(err, MOTUS_ARGUMENT, "this shard has no trajectories: there are fewer blocks than shards");
    plan *p = calloc(1, sizeof *p);
    sweep of;
    options o;
    if (!p) return complain_memory(err);
    p->sweep = s;
    p->text.descriptor = -1;
    motus_status status = sweep_batch_make(&p->batch, s, err);
    if (!status) status = open_text(p, &of, &o, err);
    if (!status) status = sample(p, progress, err);
    stop_progress_end(progress);
    if (!p->text.buffer && !status) p->bytes = bytes_of_file(s);
    p->memory = memory_of(p);
    if (!status && s->options->json)
        report_json(p);
    else if (!status && !s->options->quiet)
        report(p);
    sweep_file_close(&p->text);
    sweep_batch_free(&p->batch);
    free(p);
    return status ? status : file_flush_output(err);
}
