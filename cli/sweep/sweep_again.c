/* Computes rows of an archive again, and compares their bytes. See sweep.h. */
#include "base/decimal.h"
#include "cli/sweep/sweep.h"
#include "cli/words/complain.h"

#include <motus-archive.h>
#include <stdlib.h>
#include <string.h>

struct sweep_again {
    const sweep *sweep;
    sweep_batch batch;
    double *its;  /* a column of the archive, with as many rows as a batch */
    double *rows; /* the numbers of the computed rows, row after row */
};

motus_status sweep_again_make(sweep_again **out, const sweep *s, motus_error *err)
{
    sweep_again *g = *out = calloc(1, sizeof *g);
    if (!g) return complain_memory(err);
    g->sweep = s;
    const motus_status status = sweep_batch_make(&g->batch, s, err);
    if (status) return status;
    const size_t most = g->batch.most < SHARD_BLOCK ? g->batch.most : SHARD_BLOCK;
    g->batch.most = most;
    g->its = malloc(most * sizeof *g->its);
    g->rows = malloc(most * s->columns * sizeof *g->rows);
    return g->its && g->rows ? MOTUS_OK : complain_memory(err);
}

void sweep_again_free(sweep_again *g)
{
    if (!g) return;
    sweep_batch_free(&g->batch);
    free(g->its);
    free(g->rows);
    free(g);
}

static void tell(const sweep_again *g, const char *column, uint64_t row, double its, double ours, char *where)
{
    char a[DECIMAL_MAX], b[DECIMAL_MAX];
    snprintf(where, SWEEP_WHERE, "trajectory %" PRIu64 ", %.80s: %s in the file, %s computed",
             shard_trajectory(&g->sweep->shard, row), column, decimal(its, a), decimal(ours, b));
}

/* Compares column k of `count` rows. */
static motus_status compare(sweep_again *g, motus_archive *a, size_t k, uint64_t row, size_t count, bool *same,
                            char *where, motus_error *err)
{
    motus_archive_column c;
    const size_t width = g->sweep->columns - 1;
    motus_archive_column_at(a, k, &c);
    const unsigned char *words = (unsigned char *)g->its;
    motus_status status = motus_archive_read(a, k, row, count, g->its, err);
    for (size_t i = 0; !status && *same && i < count; i++) {
        const double ours = g->rows[i * width + k];
        const bool word = c.kind == MOTUS_ARCHIVE_WORD;
        *same = word ? words[i] == (unsigned char)ours : memcmp(&ours, g->its + i, sizeof ours) == 0;
        if (!*same) tell(g, c.name, row + i, word ? words[i] : g->its[i], ours, where);
    }
    return status;
}

motus_status sweep_again_rows(sweep_again *g, motus_archive *a, uint64_t row, size_t count, bool *same,
                              char where[SWEEP_WHERE], motus_error *err)
{
    const sweep *s = g->sweep;
    motus_status status = MOTUS_OK;
    *same = true;
    for (size_t done = 0; !status && *same && done < count;) {
        const size_t some = count - done < g->batch.most ? count - done : g->batch.most;
        status = sweep_batch_compute(&g->batch, s, row + done, some, NULL, err);
        const sweep_rows rows = sweep_batch_rows(&g->batch);
        if (!status) sweep_row_numbers(s, &rows, 0, some, g->rows, s->columns - 1, 1);
        for (size_t k = 0; !status && *same && k < s->columns - 1; k++)
            status = compare(g, a, k, row + done, some, same, where, err);
        done += some;
    }
    return status;
}
