/* Adds 1 to a number of an archive, and writes its block with the hash that fits: change FILE COLUMN ROW */
#include <motus-archive.h>
#include <stdio.h>
#include <stdlib.h>

enum { COLUMNS = 16, ROWS = 4096 };

int main(int argc, char **argv)
{
    static double room[COLUMNS][ROWS];
    const void *columns[COLUMNS];
    motus_archive *a;
    motus_error err = motus_default_error();
    uint64_t first;
    size_t count;
    if (argc != 4 || motus_archive_open(argv[1], 1, &a, &err)) return fputs("cannot open it\n", stderr), 1;
    const uint64_t row = strtoull(argv[3], NULL, 10), block = row / ROWS;
    motus_archive_block(a, block, &first, &count);
    for (size_t k = 0; k < motus_archive_column_count(a); k++) {
        motus_archive_read(a, k, first, count, room[k], &err);
        columns[k] = room[k];
    }
    room[atoi(argv[2])][row - first] += 1;
    motus_status status = motus_archive_write(a, block, columns, &err);
    motus_archive_close(a);
    return status != MOTUS_OK;
}
