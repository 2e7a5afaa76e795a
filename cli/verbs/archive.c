/* motus archive: what an archive contains; its rows as CSV, its model, or its state.
 *
 * Invariant: the CSV is, byte for byte, what the sweep would have written to a file whose name ends in .csv.
 */
#include "base/decimal.h"
#include "cli/files/archived.h"
#include "cli/files/stop.h"
#include "cli/run/csv.h"
#include "cli/sweep/sweep.h"
#include "cli/verbs/archive.h"
#include "cli/words/complain.h"
#include "cli/words/options.h"
#include "cli/words/text.h"

#include <inttypes.h>
#include <math.h>
#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>

typedef struct contents {
    const options *options;
    motus_archive *file;
    uint64_t blocks, missing, first_missing;
    uint64_t damaged; /* of the missing blocks, those with a hash that does not match their bytes */
    uint64_t *whole;  /* the numbers of the blocks that are not missing */
    size_t columns;
    bool run; /* the archive is that of a run, not of a sweep */
    archive_verified verified;
} contents;

/* Finds the blocks whose hashes match their bytes. */
static motus_status find_blocks(contents *c, stop_progress *progress, motus_error *err)
{
    c->whole = calloc((size_t)c->blocks + 1, sizeof *c->whole);
    motus_status status = c->whole ? MOTUS_OK : complain_memory(err);
    for (uint64_t b = 0; !status && b < c->blocks; b++) {
        int written, whole;
        /* In this order, since another program may be writing the block, and writes its hash last. */
        status = motus_archive_written(c->file, b, &written, err);
        if (!status) status = motus_archive_whole(c->file, b, &whole, err);
        if (!status) status = archived_numbers(c->file, c->options->operand, b, err);
        if (!status && whole) c->whole[b - c->missing] = b;
        if (!status && !whole && c->missing++ == 0) c->first_missing = b;
        if (!status && !whole && written) c->damaged++;
        if (!status && stop_progress_hook(progress, (double)b / (double)c->blocks))
            status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    return status;
}

/* ---- the rows as CSV ---- */

static motus_status put_head(const contents *c, file_out *out, motus_error *err)
{
    char line[SWEEP_IDENTITY];
    const char *share = motus_archive_note_of(c->file, "shard");
    motus_status status = file_text(out, "# ", err);
    if (!status) status = file_text(out, archived_note(c->file, "command"), err);
    snprintf(line, sizeof line, "\n# motus %.40s, trajectories %.24s, fingerprint %.32s%s%.32s\n",
             archived_note(c->file, "motus"), archived_note(c->file, "trajectories"),
             archived_note(c->file, "fingerprint"), share ? ", shard " : "", share ? share : "");
    if (!status) status = file_text(out, line, err);
    if (!status) status = file_text(out, "index", err);
    for (size_t k = 0; !status && k < c->columns; k++) {
        motus_archive_column column;
        motus_archive_column_at(c->file, k, &column);
        status = file_text(out, ",", err);
        if (!status) status = csv_name(out, column.name, err);
    }
    return status ? status : file_text(out, "\n", err);
}

typedef struct table {
    motus_archive_column column;
    const unsigned char *words; /* `numbers` of a column of words; NULL: the column has numbers */
    double *numbers;            /* memory for a block */
} table;

/* Writes a cell: empty for a number that a trajectory does not have since it stopped, or for the time at which it
 * stopped if it did not. */
static motus_status put_cell(const table *t, size_t i, bool stopped, bool time_stopped, file_out *out, motus_error *err)
{
    char text[DECIMAL_MAX + 2] = ",";
    if (t->words) {
        const size_t w = t->words[i];
        const motus_status status = file_text(out, ",", err);
        return status ? status : file_text(out, w < t->column.word_count ? t->column.words[w] : "", err);
    }
    if (isnan(t->numbers[i]) && (stopped || time_stopped)) return file_text(out, text, err);
    text[1 + decimal_write(t->numbers[i], text + 1)] = 0;
    return file_text(out, text, err);
}

static motus_status put_rows(const contents *c, table *t, const int64_t *number, size_t count, file_out *out,
                             motus_error *err)
{
    char text[DECIMAL_MAX + 1];
    const size_t stopped = c->columns - 2;
    motus_status status = MOTUS_OK;
    for (size_t i = 0; !status && i < count; i++) {
        text[decimal_write_whole((uint64_t)number[i], text)] = 0;
        status = file_text(out, text, err);
        for (size_t k = 0; !status && k < c->columns; k++)
            status = put_cell(t + k, i, !isnan(t[stopped].numbers[i]), k == stopped, out, err);
        if (!status) status = file_text(out, "\n", err);
    }
    return status;
}

static motus_status put_blocks(const contents *c, table *t, int64_t *number, file_out *out, stop_progress *progress,
                               motus_error *err)
{
    motus_status status = MOTUS_OK;
    for (uint64_t b = 0; !status && b < c->blocks; b++) {
        uint64_t first;
        size_t count;
        motus_archive_block(c->file, b, &first, &count);
        status = motus_archive_numbers(c->file, first, count, number, err);
        for (size_t k = 0; !status && k < c->columns; k++)
            status = motus_archive_read(c->file, k, first, count, t[k].numbers, err);
        if (!status) status = put_rows(c, t, number, count, out, err);
        if (!status && stop_progress_hook(progress, (double)b / (double)c->blocks))
            status = fail(err, MOTUS_CANCELLED, "cancelled");
    }
    return status;
}

static motus_status write_csv(const contents *c, file_out *out, stop_progress *progress, motus_error *err)
{
    uint64_t first;
    size_t most;
    motus_archive_block(c->file, 0, &first, &most);
    block_room room;
    table *t = calloc(c->columns, sizeof *t);
    int64_t *number = calloc(most + 1, sizeof *number);
    motus_status status = block_room_make(&room, c->columns, most, err);
    if (!status && (!t || !number)) status = complain_memory(err);
    for (size_t k = 0; !status && k < c->columns; k++) {
        motus_archive_column_at(c->file, k, &t[k].column);
        t[k].numbers = room.columns[k];
        if (t[k].column.kind == MOTUS_ARCHIVE_WORD) t[k].words = (unsigned char *)room.columns[k];
    }
    if (!status) status = put_head(c, out, err);
    if (!status) status = put_blocks(c, t, number, out, progress, err);
    block_room_free(&room);
    free(t);
    free(number);
    return status;
}

static motus_status check_sweep(const contents *c, motus_error *err)
{
    if (archived_sweep(c->file)) return MOTUS_OK;
    return fail(err, MOTUS_STATE, "%s is not the archive of a sweep", c->options->operand);
}

/* Returns the options with which the archive's own command computes the missing blocks. */
static const char *again(const contents *c)
{
    if (motus_archive_compressed(c->file)) return "--force --compress";
    return !c->run || archive_run_goes_on(c->file, c->missing, c->first_missing) ? "--resume" : "--force";
}

static motus_status incomplete(const contents *c, motus_error *err)
{
    fail(err, MOTUS_STATE, "%" PRIu64 " of %" PRIu64 " blocks of %s are missing or damaged", c->missing, c->blocks,
         c->options->operand);
    hint(err, "compute them: %.400s -o %s %s", archived_note(c->file, "command"), c->options->operand, again(c));
    return MOTUS_STATE;
}

typedef enum wanted { ROWS, MODEL, STATE, NOTHING } wanted;

/* Returns what to write, by the ending of the file's name. */
static wanted by_name(const contents *c)
{
    const char *name = c->options->output, *end = strrchr(name, '.');
    if (strcmp(name, "-") == 0 || (end && strcmp(end, ".csv") == 0)) return ROWS;
    if (end && strcmp(end, ".motus") == 0) return MODEL;
    return c->run && end && strcmp(end, ".state") == 0 ? STATE : NOTHING;
}

static motus_status extract(const contents *c, stop_progress *progress, motus_error *err)
{
    const char *name = c->options->output;
    const wanted what = by_name(c);
    if (what == NOTHING) {
        fail(err, MOTUS_ARGUMENT, "-o %s: the name must end in .csv%s", name,
             c->run ? ", .motus or .state" : " or .motus");
        hint(err, "-o rows.csv writes the rows, -o model.motus the model%s", c->run ? ", -o end.state the state" : "");
        return MOTUS_ARGUMENT;
    }
    file_out out = {0};
    motus_status status = what == ROWS && !c->run ? check_sweep(c, err) : MOTUS_OK;
    if (!status && what == ROWS && c->missing) status = incomplete(c, err);
    if (!status) status = file_create(&out, name, err);
    if (!status)
        status = what == MODEL   ? file_text(&out, archived_note(c->file, "model"), err)
                 : what == STATE ? archive_run_state(c->file, c->options, &out, err)
                 : c->run        ? archive_run_csv(c->file, c->options, &out, progress, err)
                                 : write_csv(c, &out, progress, err);
    if (!status) status = file_finish(&out, err);
    if (!status) status = file_keep(&out, err);
    file_drop(&out);
    return status;
}

/* ---- the report ---- */

static void report_json(const contents *c)
{
    json j = text_json(stdout);
    json_string(&j, "motus", archived_note(c->file, "motus"));
    json_string(&j, "command", archived_note(c->file, "command"));
    json_string(&j, "method", archived_note(c->file, "method"));
    json_string(&j, "fingerprint", archived_note(c->file, "fingerprint"));
    json_string(&j, "shard", motus_archive_note_of(c->file, "shard"));
    json_integer(&j, "rows", (int64_t)motus_archive_rows(c->file));
    json_integer(&j, "blocks", (int64_t)c->blocks);
    json_integer(&j, "missing", (int64_t)c->missing);
    json_bool(&j, "compressed", motus_archive_compressed(c->file));
    if (c->options->verify) json_integer(&j, "verified", (int64_t)c->verified.computed);
    json_open(&j, "columns", '[');
    motus_archive_column column;
    for (size_t k = 0; motus_archive_column_at(c->file, k, &column); k++) json_string(&j, NULL, column.name);
    json_close(&j, ']');
    json_string(&j, "output", c->options->output);
    json_end(&j);
}

static void line(const char *what, const char *text)
{
    printf("  %-13s", what);
    text_put(stdout, text);
    putchar('\n');
}

static void report(const contents *c)
{
    const char *share = motus_archive_note_of(c->file, "shard");
    text_put(stdout, c->options->operand);
    printf(": an archive of motus %.40s\n\n", archived_note(c->file, "motus"));
    line("command", archived_note(c->file, "command"));
    line("method", archived_note(c->file, "method"));
    if (share) line("shard", share);
    printf("  %-13s%" PRIu64 ", in %" PRIu64 " %sblock%s: ", c->run ? "rows" : "trajectories",
           motus_archive_rows(c->file), c->blocks, motus_archive_compressed(c->file) ? "compressed " : "",
           c->blocks == 1 ? "" : "s");
    if (!c->missing) puts("all there, and their hashes match");
    if (c->missing > c->damaged) printf("%" PRIu64 " missing%s", c->missing - c->damaged, c->damaged ? " and " : "");
    if (c->damaged) printf("%" PRIu64 " damaged", c->damaged);
    if (c->missing) printf(", the first of them number %" PRIu64 "\n", c->first_missing + 1);
    if (c->options->verify && c->run)
        printf("  %-13sthe first %" PRIu64 " rows, computed again, have the same bytes\n", "verified",
               c->verified.computed);
    else if (c->options->verify)
        printf("  %-13s%" PRIu64 " of these blocks, computed again, %s the same bytes\n", "verified",
               c->verified.computed, c->verified.computed == 1 ? "has" : "have");
    printf("  %-13s", "columns");
    motus_archive_column column;
    for (size_t k = 0; motus_archive_column_at(c->file, k, &column); k++) {
        if (k) fputs(", ", stdout);
        text_put(stdout, column.name);
    }
    putchar('\n');
    if (c->run && !archive_run_goes_on(c->file, c->missing, c->first_missing))
        puts("\nmotus run cannot continue this file: it has no state with all the rows before it; its command with "
             "--force computes it again");
    else if (c->missing && c->run)
        puts("\nmotus run continues this file");
    else if (c->missing > c->damaged)
        puts("\nthe command with -o and --resume computes what is missing");
}

/* Fails if a block of a sweep is damaged. A run that continues writes its last block again, so a kill may leave that
 * block damaged. */
static motus_status judge(const contents *c, motus_error *err)
{
    if (c->run || !c->damaged) return MOTUS_OK;
    fail(err, MOTUS_STATE, "%s is damaged: %" PRIu64 " of its %" PRIu64 " blocks %s not match %s hash",
         c->options->operand, c->damaged, c->blocks, c->damaged == 1 ? "does" : "do",
         c->damaged == 1 ? "its" : "their");
    hint(err, "use a copy of the file, or compute the damaged blocks: %.400s -o %s %s",
         archived_note(c->file, "command"), c->options->operand, again(c));
    return MOTUS_STATE;
}

static motus_status check(const options *o, motus_error *err)
{
    if (!o->operand) return complain(err, MOTUS_ARGUMENT, "motus archive swings.h5", "motus archive needs an archive");
    double part;
    motus_status status = o->verify ? archive_verify_part(o->verify, &part, err) : MOTUS_OK;
    if (status) return status;
    if (o->json && o->output && strcmp(o->output, "-") == 0)
        return fail(err, MOTUS_ARGUMENT, "--json and the rows both go to standard output");
    return o->output ? target_check(o, o->output, err) : MOTUS_OK;
}

motus_status archive_verb(const options *o, motus_error *err)
{
    contents c = {.options = o};
    stop_progress progress = stop_progress_begin("archive", o->quiet);
    motus_status status = check(o, err);
    if (!status) status = motus_archive_open(o->operand, 0, &c.file, err);
    if (!status) {
        stop_catch_signals();
        c.blocks = motus_archive_blocks(c.file);
        c.columns = motus_archive_column_count(c.file);
        c.run = archive_run_is(c.file);
        status = find_blocks(&c, &progress, err);
        if (!status && o->verify && c.run)
            status = archive_verify_run(c.file, o, c.first_missing, c.missing > 0, &c.verified, &progress, err);
        else if (!status && o->verify)
            status = archive_verify(c.file, o, c.whole, c.blocks - c.missing, &c.verified, &progress, err);
        if (!status && c.verified.differ > 0) status = archive_verify_failed(&c.verified, o, c.run, err);
        if (!status && o->output) status = extract(&c, &progress, err);
        stop_progress_end(&progress);
    }
    if (!status && !o->json && !o->quiet && !o->output) report(&c);
    if (!status && !o->output) status = judge(&c, err);
    if (!status && o->json) report_json(&c);
    motus_archive_close(c.file);
    free(c.whole);
    return status ? status : file_flush_output(err);
}
