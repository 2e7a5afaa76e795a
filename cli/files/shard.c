/* Shards of a sweep. See shard.h. */
#include "cli/files/shard.h"

#include "base/decimal.h"
#include "cli/words/complain.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool whole_number(const char *text, uint64_t *value)
{
    const size_t length = text ? strlen(text) : 0;
    return length > 0 && decimal_read_whole(text, length, value) == length;
}

/* Reads the shard from the environment of a Slurm task. The array must be 1-N; for another one, such as a single task
 * that was submitted again, N is not known. */
static motus_status of_slurm(shard *s, motus_error *err)
{
    const char *const names[] = {"SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", "SLURM_ARRAY_TASK_MIN",
                                 "SLURM_ARRAY_TASK_MAX"};
    uint64_t value[4];
    for (size_t k = 0; k < 4; k++) {
        if (whole_number(getenv(names[k]), &value[k])) continue;
        return complain(err, MOTUS_ARGUMENT, "submit an array, sbatch --array=1-100, or name the shard: --shard 3/100",
                        "--shard slurm: %s is not a number in the environment", names[k]);
    }
    *s = (shard){value[0], value[1], SHARD_BLOCK};
    if (value[2] == 1 && value[3] == value[1] && s->number >= 1 && s->number <= s->count) return MOTUS_OK;
    fail(err, MOTUS_ARGUMENT,
         "--shard slurm: this array has tasks %" PRIu64 " to %" PRIu64 " (%" PRIu64 " of them), not 1 to N", value[2],
         value[3], value[1]);
    hint(err, "submit all as --array=1-N; to compute one shard again, name it: --shard %" PRIu64 "/N", s->number);
    return MOTUS_ARGUMENT;
}

#define BLOCKS " in blocks of "

size_t shard_parse(shard *s, const char *text)
{
    const size_t length = strlen(text), first = decimal_read_whole(text, length, &s->number);
    if (first == 0 || text[first] != '/') return 0;
    const size_t second = decimal_read_whole(text + first + 1, length - first - 1, &s->count);
    s->block = SHARD_BLOCK;
    if (second == 0 || s->number < 1 || s->number > s->count) return 0;
    const size_t short_end = first + 1 + second, words = sizeof BLOCKS - 1;
    if (strncmp(text + short_end, BLOCKS, words) != 0) return short_end;
    const size_t third = decimal_read_whole(text + short_end + words, length - short_end - words, &s->block);
    return third > 0 && s->block > 0 && s->block < SHARD_BLOCK ? short_end + words + third : 0;
}

motus_status shard_read(shard *s, const char *text, motus_error *err)
{
    *s = (shard){1, 1, SHARD_BLOCK};
    if (!text) return MOTUS_OK;
    motus_status status = MOTUS_OK;
    if (strcmp(text, "slurm") == 0) {
        status = of_slurm(s, err);
    } else {
        const size_t length = shard_parse(s, text);
        if (length == 0 || text[length] || s->block != SHARD_BLOCK) {
            status = complain(err, MOTUS_ARGUMENT, "--shard 3/100 is the third of a hundred: from 1/100 to 100/100",
                              "--shard %s: this is not a shard", text);
        }
    }
    if (!status && s->count > SHARD_MOST) {
        fail(err, MOTUS_ARGUMENT, "--shard %s: at most %d shards", text, SHARD_MOST);
        status = MOTUS_ARGUMENT;
    }
    return status;
}

bool shard_whole(const shard *s) { return s->count == 1; }

const char *shard_text(const shard *s, char out[SHARD_TEXT])
{
    snprintf(out, SHARD_TEXT, "%u/%u", (unsigned)s->number, (unsigned)s->count);
    return out;
}

const char *shard_title(const shard *s, char out[SHARD_TITLE])
{
    char text[SHARD_TEXT];
    if (s->block == SHARD_BLOCK)
        snprintf(out, SHARD_TITLE, "%s", shard_text(s, text));
    else
        snprintf(out, SHARD_TITLE, "%s" BLOCKS "%u", shard_text(s, text), (unsigned)s->block);
    return out;
}

uint64_t shard_rows(const shard *s, uint64_t total)
{
    const uint64_t full = total / s->block, last = total % s->block, first = s->number - 1;
    const uint64_t mine = full > first ? (full - first - 1) / s->count + 1 : 0;
    return mine * s->block + (full % s->count == first ? last : 0);
}

uint64_t shard_trajectory(const shard *s, uint64_t row)
{
    return (s->number - 1 + row / s->block * s->count) * s->block + row % s->block;
}

uint64_t shard_run(const shard *s, uint64_t row) { return shard_whole(s) ? UINT64_MAX : s->block - row % s->block; }

char *shard_file(const shard *s, const char *name)
{
    size_t marks = 0;
    for (const char *at = strstr(name, "%K"); at && !shard_whole(s); at = strstr(at + 2, "%K")) marks++;
    char *out = malloc(strlen(name) + marks * SHARD_TEXT + 1);
    if (!out) return NULL;
    size_t n = 0;
    for (const char *at = name; *at;) {
        if (marks == 0 || strncmp(at, "%K", 2) != 0) {
            out[n++] = *at++;
            continue;
        }
        n += (size_t)sprintf(out + n, "%u", (unsigned)s->number);
        at += 2;
    }
    out[n] = 0;
    return out;
}
