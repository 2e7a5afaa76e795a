/* The directory of an archive, with a hash that fits whatever its bytes are, so that what stands behind it is reached.
 */
#include "archive/directory.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size > 3000) return 0;
    char bytes[DIRECTORY_LEAST] = "", body[3001] = "";
    memcpy(body, data, size);
    const size_t length = strlen(body);
    snprintf(bytes, sizeof bytes, "motus archive 1\ndirectory %d %016" PRIx64 "\n%s", DIRECTORY_LEAST,
             directory_hash(DIRECTORY_HASH, body, length), body);
    directory d;
    size_t wanted = 0;
    if (directory_read(&d, bytes, sizeof bytes, 1 << 20, "it", &wanted, NULL) == MOTUS_OK) {
        if (!d.column_count || !d.block) abort();
        for (size_t k = 0; k < d.column_count; k++) {
            const uint64_t width = d.columns[k].width;
            if (width == 0) abort();
            if (d.rows && (d.columns[k].place < d.size || d.columns[k].place + d.rows * width > 1 << 20)) abort();
            for (size_t w = 0; w < d.columns[k].word_count; w++) (void)strlen(d.columns[k].words[w]);
        }
        if (d.slot && (d.slots_place < d.size || d.slot > 1 << 19 || d.slots_place + 2 * d.slot > 1 << 20)) abort();
        for (size_t k = 0; k < d.note_count; k++) (void)strlen(d.notes[k].text);
    }
    directory_free(&d);
    (void)directory_read(&d, (const char *)data, size, size, "it", &wanted, NULL);
    directory_free(&d);
    return 0;
}
