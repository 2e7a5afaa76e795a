/* See archive_verify.h. */
#include "cli/words/complain.h"
#include "cli/verbs/archive_verify.h"

#include "base/decimal.h"
#include "cli/words/typed.h"
#include "cli/run/run_again.h"
#include "cli/run/run_archive.h"
#include "cli/run/run_command.h"

#include <math.h>
#include <motus-archive.h>
#include <string.h>

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
                        "--verify %.80s: this is no part of an archive", text);
    *part = percent / 100;
    return MOTUS_OK;
}

/* A number from 0 to 1 that is another one each time. */
static double somewhere(void) { return fmod(stop_clock() * 1e6, 1); }

motus_status archive_verify(motus_archive *a, const options *o, const uint64_t *blocks, uint64_t count,
                            archive_verified *v, stop_progress *progress, motus_error *err)
{
    double part;
    *v = (archive_verified){0};
    motus_status status = archive_verify_part(o->verify, &part, err);
    if (status || count == 0) return status;
    sweep_origin origin;
    sweep_again *again = NULL;
    const double some = fmin(ceil(part * (double)count), (double)count), offset = somewhere();
    status = sweep_origin_open(&origin, a, o, err);
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
    sweep_origin_close(&origin);
    return status;
}

/* A run that went on is computed to its first end, with the rows before it. */
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
        fail(err, MOTUS_FILE, "%s is not what is computed; %s", o->operand, v->where);
    else
        fail(err, MOTUS_FILE, "%s: %" PRIu64 " of %" PRIu64 " blocks are not what is computed; %s", o->operand,
             v->differ, v->computed, v->where);
    hint(err, "its command with --force makes it anew");
    return MOTUS_FILE;
}
