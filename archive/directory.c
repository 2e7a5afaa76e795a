/* Writes the directory of an archive. See directory.h. */
#include "archive/directory.h"

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FIRST "motus archive "
#define PLACE "%020" PRIu64
const char *const directory_kinds[] = {[MOTUS_ARCHIVE_NUMBER] = "number", [MOTUS_ARCHIVE_WORD] = "word"};

size_t motus_archive_width(const motus_archive_column *c)
{
    return (c->shape[0] ? c->shape[0] : 1) * (c->shape[1] ? c->shape[1] : 1);
}

/* Hashes as FNV-1a does, over words of 64 bits; the high half is folded into the low one, so that its bits count in
 * what follows.
 */
uint64_t directory_hash(uint64_t h, const void *bytes, size_t count)
{
    const unsigned char *at = bytes;
    const uint64_t prime = UINT64_C(0x100000001B3) | UINT64_C(0x9E3779B900000000);
    for (; count >= 8; at += 8, count -= 8) {
        uint64_t word;
        memcpy(&word, at, sizeof word);
        h = (h ^ word) * prime;
        h ^= h >> 32;
    }
    for (; count > 0; at++, count--) {
        h = (h ^ *at) * prime;
        h ^= h >> 32;
    }
    return h;
}

static void put_body(FILE *out, const motus_archive_def *d, const uint64_t *places)
{
    const uint64_t *at = places;
    fprintf(out, "rows " PLACE "\nblock " PLACE "\n", d->rows, d->block);
    fprintf(out, "number " PLACE " %s\n", at ? *at++ : 0, d->scale);
    fprintf(out, "done " PLACE "\n", at ? *at++ : 0);
    if (d->from) fprintf(out, "packed " PLACE "\n", at ? at[d->column_count + 1] : 0);
    if (d->slot) fprintf(out, "slots " PLACE " %zu\n", at ? at[d->column_count] : 0, d->slot + DIRECTORY_SLOT);
    for (size_t k = 0; k < d->column_count; k++) {
        const motus_archive_column *c = d->columns + k;
        char shape[64] = "";
        if (c->shape[1])
            snprintf(shape, sizeof shape, "[%zux%zu]", c->shape[0], c->shape[1]);
        else if (c->shape[0])
            snprintf(shape, sizeof shape, "[%zu]", c->shape[0]);
        fprintf(out, "column %s%s " PLACE " %s\n", directory_kinds[c->kind], shape, at ? *at++ : 0, c->name);
        if (c->comment) fprintf(out, "comment %s\n", c->comment);
        for (size_t w = 0; w < c->word_count; w++) fprintf(out, "word %s\n", c->words[w]);
    }
    for (size_t k = 0; k < d->note_count; k++)
        fprintf(out, "note %zu %s\n%s\n", strlen(d->notes[k].text), d->notes[k].name, d->notes[k].text);
    fputs("end\n", out);
}

char *directory_write(const motus_archive_def *d, const uint64_t *places, size_t *size)
{
    char *body = NULL, head[DIRECTORY_HEAD];
    size_t length = 0;
    FILE *out = open_memstream(&body, &length);
    if (!out) return NULL;
    put_body(out, d, places);
    const bool failed = ferror(out) != 0;
    char *text = NULL;
    if (fclose(out) == 0 && !failed) {
        *size = DIRECTORY_LEAST;
        while (*size < length + DIRECTORY_HEAD) *size *= 2;
        text = calloc(1, *size);
    }
    if (text) {
        snprintf(head, sizeof head, FIRST "%d\ndirectory %zu %016" PRIx64 "\n", d->from ? 2 : 1, *size,
                 directory_hash(DIRECTORY_HASH, body, length));
        memcpy(text, head, strlen(head));
        memcpy(text + strlen(head), body, length);
    }
    free(body);
    return text;
}
