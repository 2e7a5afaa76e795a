/* The sweep that made an archive: its command and its model are in the file. See sweep.h.
 *
 * Invariant: whatever the command of a file says, no file is written by it.
 */
#include "cli/words/complain.h"
#include "cli/sweep/sweep.h"
#include "cli/words/words.h"

#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>

static motus_status no_command(motus_error *err)
{
    return fail(err, MOTUS_STATE, "the archive does not say which sweep made it");
}

/* The options of its command, without those that name files of results. */
static motus_status read_command(sweep_origin *g, const char *command, const options *asked, motus_error *err)
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
    fail(err, MOTUS_STATE, "the command in the archive does not make its fingerprint");
    hint(err,
         "a file of values (--vary F=@FILE) may have changed, or the archive was changed by hand; motus %.40s "
         "made it",
         version);
    return MOTUS_STATE;
}

motus_status sweep_origin_open(sweep_origin *g, motus_archive *a, const options *asked, motus_error *err)
{
    *g = (sweep_origin){0};
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

void sweep_origin_close(sweep_origin *g)
{
    sweep_free(&g->sweep);
    options_free(&g->options);
    free(g->argv.items);
    free(g->words);
    *g = (sweep_origin){0};
}
