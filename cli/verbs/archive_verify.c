/* motus archive --verify: computes blocks of an archive again.
 *
 * Invariant: no file is written, whatever the command in the archive says.
 */
#include "cli/verbs/archive.h"

#include "base/decimal.h"
#include "cli/run/run.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"
#include "cli/words/words.h"

#include <math.h>
#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>

/* The sweep that made an archive, by the command and the model in the archive. */
typedef struct origin {
    sweep sweep;
    options options; /* of that command, without files of results, and with our threads and machine */
    char *words;     /* of the command */
    options_list argv;
    stop_progress progress; /* shows nothing, but obeys signals */
} origin;

static motus_status no_command(motus_error *err)
{
    return fail(err, MOTUS_STATE, "the archive does not say which sweep made it");
}

/* Reads the options of the command, without those that name files of results. */
static motus_status read_command(origin *g, const char *command, const options *asked, motus_error *err)
{
    motus_status status = words_split(command, &g->words, &g->argv, err);
    if (status) return status;
    const char **words = g->argv.items;
    if (g->argv.count < 2 || strcmp(words[0], "motus") != 0 || strcmp(words[1], "sweep") != 0) return no_command(err);
    status = options_read(&g->options, VERB_SWEEP, (int)g->argv.count, (char **)words, 2, err);
    options *o = &g->options;
    if (!status && o->help) return no_command(err);
    options_forget(o, OF_WHATEVER);
    options_take(o, asked, OF_MACHINE);
    o->quiet = true;
    return status;
}

static motus_status other_sweep(const char *version, motus_error *err)
{
    fail(err, MOTUS_STATE, "the archive's command has another fingerprint than the archive");
    hint(err,
         "a file of values (--vary F=@FILE) may have changed, or the archive was changed by hand; motus %.40s "
         "made it",
         version);
    return MOTUS_STATE;
}

/* Prepares the sweep that made an archive. MOTUS_STATE: its command does not make this archive. Call origin_close() in
 * any case. */
static motus_status origin_open(origin *g, motus_archive *a, const options *asked, motus_error *err)
{
    *g = (origin){0};
    const char *command = motus_archive_note_of(a, "command"), *model = motus_archive_note_of(a, "model"),
               *version = motus_archive_note_of(a, "motus"), *print = motus_archive_note_of(a, "fingerprint");
    char own[SWEEP_FINGERPRINT];
    sweep_section none = {0};
    if (!command || !model || !version || !print) return no_command(err);
    motus_status status = read_command(g, command, asked, err);
    g->options.text = model;
    g->progress = stop_progress_begin("sweep", true);
    g->sweep.options = &g->options;
    g->sweep.block = motus_archive_block_rows(a);
    if (!status) status = shard_read(&g->sweep.shard, g->options.shard, err);
    if (!status) status = sweep_begin(&g->sweep, &none, &g->progress, err);
    if (status) return status;
    if (strcmp(sweep_head_fingerprint(&g->sweep, version, own), print) != 0 || motus_archive_rows(a) != g->sweep.rows ||
        motus_archive_column_count(a) != g->sweep.columns - 1)
        return other_sweep(version, err);
    return MOTUS_OK;
}

static void origin_close(origin *g)
{
    sweep_free(&g->sweep);
    options_free(&g->options);
    free(g->argv.items);
    free(g->words);
    *g = (origin){0};
}

motus_status archive_verify_part(const char *text, double *part, motus_error *err)
{
    char number[256] = "";
    motus_error none = motus_default_error();
    const size_t length = strlen(text);
    double percent = 100;
    *part = 1;
    if (strcmp(text, "all") == 0) return MOTUS_OK;
    const bool ends = length > 1 && length <= sizeof number && text[length - 1] == '%';
    if (ends) memcpy(number, text, length - 1);
    if (!ends || typed_constant(number, "", &percent, &none) || !(percent > 0) || percent > 100)
        return complain(err, MOTUS_ARGUMENT,
                        "--verify 1% computes a hundredth of its blocks again, --verify all every one",
                        "--verify %.80s: this is not a part of an archive", text);
    *part = percent / 100;
    return MOTUS_OK;
}

/* Returns a number from 0 to 1, another one at each call. */
static double somewhere(void) { return fmod(stop_clock() * 1e6, 1); }

motus_status archive_verify(motus_archive *a, const options *o, const uint64_t *blocks, uint64_t count,
                            archive_verified *v, stop_progress *progress, motus_error *err)
{
    double part;
    *v = (archive_verified){0};
    motus_status status = archive_verify_part(o->verify, &part, err);
    if (status || count == 0) return status;
    origin origin;
    sweep_again *again = NULL;
    const double some = fmin(ceil(part * (double)count), (double)count), offset = somewhere();
    status = origin_open(&origin, a, o, err);
    if (!status) status = sweep_again_make(&again, &origin.sweep, err);
    for (; !status && (double)v->computed < some; v->computed++) {
        const uint64_t k = (uint64_t)(((double)v->computed + offset) / some * (double)count);
        uint64_t first;
        size_t rows;
        bool same;
        char where[SWEEP_WHERE];
        motus_archive_block(a, blocks[k < count ? k : count - 1], &first, &rows);
        status = sweep_again_rows(again, a, first, rows, &same, where, err);
        if (!status && !same && v->differ++ == 0) memcpy(v->where, where, sizeof where);
        if (!status && stop_progress_hook(progress, (double)v->computed / some))
            status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    sweep_again_free(again);
    origin_close(&origin);
    return status;
}

/* Ends a run that was continued at its first end, and limits *rows to those before that end. */
static void up_to_first_end(options *o, motus_archive *a, uint64_t *rows)
{
    const char *text = motus_archive_note_of(a, RUN_FIRST_END);
    double time;
    uint64_t most;
    const size_t length = text ? decimal_read(text, strlen(text), &time) : 0;
    if (!length || text[length] != ' ' || !decimal_read_whole(text + length + 1, strlen(text + length + 1), &most))
        return;
    o->until = time;
    if (*rows > most) *rows = most;
}

motus_status archive_verify_run(motus_archive *a, const options *o, uint64_t first_missing, bool missing,
                                archive_verified *v, stop_progress *progress, motus_error *err)
{
    double part;
    uint64_t rows = motus_archive_rows(a);
    size_t count;
    run_command command;
    bool same = true;
    *v = (archive_verified){0};
    motus_status status = archive_verify_part(o->verify, &part, err);
    if (status) return status;
    if (missing) motus_archive_block(a, first_missing, &rows, &count);
    v->computed = (uint64_t)fmin(ceil(part * (double)rows), (double)rows);
    status = run_command_of(&command, a, o, err);
    if (!status) up_to_first_end(&command.options, a, &v->computed);
    if (!status && v->computed > 0)
        status = run_again_rows(&command.options, a, v->computed, &same, v->where, progress, err);
    v->differ = !same;
    run_command_free(&command);
    return status;
}

motus_status archive_verify_failed(const archive_verified *v, const options *o, bool run, motus_error *err)
{
    if (run)
        fail(err, MOTUS_FILE, "%s differs from what is computed; %s", o->operand, v->where);
    else
        fail(err, MOTUS_FILE, "%s: %" PRIu64 " of %" PRIu64 " blocks differ from what is computed; %s", o->operand,
             v->differ, v->computed, v->where);
    hint(err, "its command with --force computes it again");
    return MOTUS_FILE;
}
