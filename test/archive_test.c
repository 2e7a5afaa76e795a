/* Archives: whatever is done to the bytes of a file, opening it ends with an error or with an archive all of whose
 * places are inside the file; and only blocks whose bytes are those that were written are whole. */
#include "archive/directory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { ROWS = 1000, BLOCK = 64, BLOCKS = 16, COLUMNS = 4, WORDS = 3, WIDE = 6, SLOT = 500 };
static const char *const words[WORDS] = {"", "singular", "two words"};
static const motus_archive_column columns[COLUMNS] = {
    {"x", MOTUS_ARCHIVE_NUMBER, NULL, 0, {0, 0}, "m, column"},
    {"max(a/b) \xc3\xa9", MOTUS_ARCHIVE_NUMBER, NULL, 0, {0, 0}, NULL},
    {"stopped_by", MOTUS_ARCHIVE_WORD, words, WORDS, {0, 0}, NULL},
    {"r", MOTUS_ARCHIVE_NUMBER, NULL, 0, {3, 2}, NULL},
};
static size_t bytes_of_row(int k) { return directory_width(columns[k].kind) * motus_archive_width(columns + k); }
static const motus_archive_note notes[] = {
    {"motus", "1.2.3"}, {"model", "x'' = -x\nx(0) = 1\nend\nrows 7\n"}, {"empty", ""}};

static motus_archive_def definition(void)
{
    motus_archive_def d = motus_archive_default();
    d.rows = ROWS, d.block = BLOCK, d.columns = columns, d.column_count = COLUMNS;
    d.notes = notes, d.note_count = sizeof notes / sizeof *notes;
    d.slot = SLOT;
    return d;
}

/* The bytes of a file without HDF5's part: the directory, then the columns one behind the other. */
static char *make_bytes(size_t *size)
{
    const motus_archive_def d = definition();
    uint64_t places[3 + COLUMNS];
    char *text = directory_write(&d, NULL, size);
    assert_non_null(text);
    free(text);
    size_t all = *size;
    places[0] = all, all += ROWS * sizeof(int64_t);
    places[1] = all, all += BLOCKS * sizeof(uint64_t);
    for (int k = 0; k < COLUMNS; k++) places[2 + k] = all, all += ROWS * bytes_of_row(k);
    places[2 + COLUMNS] = all, all += (size_t)2 * (SLOT + DIRECTORY_SLOT);
    text = directory_write(&d, places, size);
    assert_non_null(text);
    char *bytes = calloc(1, all);
    memcpy(bytes, text, *size);
    free(text);
    *size = all;
    return bytes;
}

static void write_file(const char *path, const char *bytes, size_t size)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

typedef struct fixture {
    char path[64], *bytes;
    size_t size;
} fixture;

static int begin(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    strcpy(f->path, "/tmp/motus-archive-XXXXXX");
    const int descriptor = mkstemp(f->path);
    if (descriptor < 0) return 1;
    close(descriptor);
    f->bytes = make_bytes(&f->size);
    write_file(f->path, f->bytes, f->size);
    *state = f;
    return 0;
}

static int end(void **state)
{
    fixture *f = *state;
    unlink(f->path);
    free(f->bytes);
    free(f);
    return 0;
}

static void says_what_was_said(void **state)
{
    const fixture *f = *state;
    motus_archive *a;
    motus_archive_column c;
    motus_archive_note n;
    assert_int_equal(motus_archive_open(f->path, 0, &a, NULL), MOTUS_OK);
    assert_int_equal(motus_archive_rows(a), ROWS);
    assert_int_equal(motus_archive_blocks(a), BLOCKS);
    assert_int_equal(motus_archive_column_count(a), COLUMNS);
    for (size_t k = 0; k < COLUMNS; k++) {
        assert_true(motus_archive_column_at(a, k, &c));
        assert_string_equal(c.name, columns[k].name);
        assert_int_equal(c.kind, columns[k].kind);
        assert_int_equal(c.word_count, columns[k].word_count);
        assert_true(c.comment ? columns[k].comment && !strcmp(c.comment, columns[k].comment) : !columns[k].comment);
        assert_memory_equal(c.shape, columns[k].shape, sizeof c.shape);
        for (size_t w = 0; w < c.word_count; w++) assert_string_equal(c.words[w], words[w]);
    }
    assert_false(motus_archive_column_at(a, COLUMNS, &c));
    for (size_t k = 0; k < sizeof notes / sizeof *notes; k++) {
        assert_true(motus_archive_note_at(a, k, &n));
        assert_string_equal(n.name, notes[k].name);
        assert_string_equal(motus_archive_note_of(a, n.name), notes[k].text);
    }
    assert_null(motus_archive_note_of(a, "absent"));
    motus_archive_close(a);
}

static void fill(double *x, double *y, unsigned char *w, double *r, uint64_t block)
{
    for (int i = 0; i < BLOCK; i++) {
        for (int k = 0; k < WIDE; k++) r[WIDE * i + k] = (double)(block * BLOCK) + i + k / 8.0;
        x[i] = (double)(block * BLOCK) + i;
        y[i] = -x[i] / 3;
        w[i] = (unsigned char)(i % WORDS);
    }
}

/* Blocks in any order; each byte of one that changes makes it missing; so does a block in the place of another. */
static void blocks(void **state)
{
    const fixture *f = *state;
    motus_archive *a;
    double x[BLOCK], y[BLOCK], back[BLOCK], r[BLOCK * WIDE], wide[BLOCK * WIDE];
    unsigned char w[BLOCK];
    const void *const written[COLUMNS] = {x, y, w, r};
    int whole;
    assert_int_equal(motus_archive_open(f->path, 1, &a, NULL), MOTUS_OK);
    for (uint64_t k = 0; k < BLOCKS; k += 2) {
        const uint64_t block = BLOCKS - 1 - k;
        fill(x, y, w, r, block);
        assert_int_equal(motus_archive_write(a, block, written, NULL), MOTUS_OK);
    }
    for (uint64_t b = 0; b < BLOCKS; b++) {
        uint64_t first;
        size_t count;
        assert_int_equal(motus_archive_whole(a, b, &whole, NULL), MOTUS_OK);
        assert_int_equal(whole, b % 2);
        motus_archive_block(a, b, &first, &count);
        assert_int_equal(count, b < BLOCKS - 1 ? BLOCK : ROWS % BLOCK);
        if (!whole) continue;
        fill(x, y, w, r, b);
        assert_int_equal(motus_archive_read(a, 1, first, count, back, NULL), MOTUS_OK);
        assert_memory_equal(back, y, count * sizeof *y);
        assert_int_equal(motus_archive_read(a, 3, first + 1, count - 1, wide, NULL), MOTUS_OK);
        assert_memory_equal(wide, r + WIDE, (count - 1) * WIDE * sizeof *r);
    }
    assert_int_equal(motus_archive_write(a, BLOCKS, written, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_archive_read(a, 1, ROWS - 1, 2, back, NULL), MOTUS_ARGUMENT);
    assert_int_equal(motus_archive_read(a, COLUMNS, 0, 1, back, NULL), MOTUS_ARGUMENT);
    motus_archive_close(a);

    directory d;
    size_t size;
    assert_int_equal(directory_read(&d, f->bytes, f->size, f->size, "it", &size, NULL), MOTUS_OK);
    FILE *file = fopen(f->path, "r+b");
    setvbuf(file, NULL, _IONBF, 0);
    assert_int_equal(motus_archive_open(f->path, 0, &a, NULL), MOTUS_OK);
    for (int k = 0; k < COLUMNS; k++)
        for (size_t i = 0; i < BLOCK * bytes_of_row(k); i++) {
            const long at = (long)(d.columns[k].place + BLOCK * bytes_of_row(k) + i);
            fseek(file, at, SEEK_SET);
            const int byte = getc(file);
            fseek(file, at, SEEK_SET);
            putc(byte ^ (1 << i % 8), file);
            assert_int_equal(motus_archive_whole(a, 1, &whole, NULL), MOTUS_OK);
            assert_false(whole);
            fseek(file, at, SEEK_SET);
            putc(byte, file);
        }
    assert_int_equal(motus_archive_whole(a, 1, &whole, NULL), MOTUS_OK);
    assert_true(whole);
    uint64_t hash;
    fseek(file, (long)d.done_place + 8, SEEK_SET);
    assert_int_equal(fread(&hash, sizeof hash, 1, file), 1);
    fseek(file, (long)d.done_place, SEEK_SET);
    assert_int_equal(fwrite(&hash, sizeof hash, 1, file), 1);
    assert_int_equal(motus_archive_whole(a, 0, &whole, NULL), MOTUS_OK);
    assert_false(whole);
    fclose(file);
    motus_archive_close(a);
    directory_free(&d);
}

/* Reads the directory of these bytes as a file of their size would have it; true: it was taken. */
static bool reads(const char *bytes, size_t size)
{
    directory d;
    size_t wanted = 0;
    motus_error err = motus_default_error();
    const motus_status status = directory_read(&d, bytes, size, size, "it", &wanted, &err);
    assert_true(status == MOTUS_OK || status == MOTUS_STATE || status == MOTUS_UNAVAILABLE);
    assert_true(status == MOTUS_OK || err.message[0]);
    directory_free(&d);
    return status == MOTUS_OK;
}

static void every_byte_matters(void **state)
{
    const fixture *f = *state;
    const size_t text = strlen(f->bytes);
    char *bytes = malloc(f->size);
    for (size_t i = 0; i < text; i++)
        for (int bit = 0; bit < 8; bit++) {
            memcpy(bytes, f->bytes, f->size);
            bytes[i] = (char)(bytes[i] ^ (1 << bit));
            /* a letter of the hash in the other case is the same hash */
            if (reads(bytes, f->size)) assert_true(bit == 5 && i < DIRECTORY_HEAD);
        }
    for (size_t size = 0; size < f->size; size++) {
        char *less = malloc(size + 1);
        memcpy(less, f->bytes, size);
        assert_false(reads(less, size));
        free(less);
    }
    free(bytes);
}

/* Places outside the file, with a hash that is right. */
static void places_are_inside(void **state)
{
    (void)state;
    const motus_archive_def d = definition();
    size_t size;
    const uint64_t good[3 + COLUMNS] = {8192, 8192, 8192, 8192, 8192, 8192, 8192};
    const uint64_t end = 8192 + ROWS * WIDE * 8, bad[] = {0,       1,          DIRECTORY_LEAST - 1, end - 7,       end,
                                                          end + 1, UINT64_MAX, UINT64_MAX - 7,      UINT64_MAX / 2};
    enum { FILE_SIZE = 8192 + ROWS * WIDE * 8 };
    char *bytes = calloc(1, FILE_SIZE), *text = directory_write(&d, good, &size);
    memcpy(bytes, text, size);
    assert_true(reads(bytes, FILE_SIZE));
    free(text);
    for (int k = 0; k < 3 + COLUMNS; k++)
        for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
            uint64_t places[3 + COLUMNS];
            memcpy(places, good, sizeof good);
            places[k] = bad[i];
            text = directory_write(&d, places, &size);
            memcpy(bytes, text, size);
            assert_false(reads(bytes, FILE_SIZE));
            free(text);
        }
    free(bytes);
}

/* A shape that no number of bytes has. */
static void shapes(void **state)
{
    static const char *const bad[] = {"[0]",
                                      "[]",
                                      "[3",
                                      "3]",
                                      "[3x]",
                                      "[x3]",
                                      "[3x0]",
                                      "[3x2x1]",
                                      "[-3]",
                                      "[3]x",
                                      "[18446744073709551615]",
                                      "[4294967296x4294967296]",
                                      "[99999999999999999999]"};
    (void)state;
    const char *const text = "rows 1\nblock 1\nnumber 4096 n\ndone 4096\ncolumn number%s 4096 x\nend\n";
    for (size_t k = 0; k <= sizeof bad / sizeof *bad; k++) {
        char body[512], *bytes = calloc(1, 8192);
        snprintf(body, sizeof body, text, k < sizeof bad / sizeof *bad ? bad[k] : "[2x3]");
        snprintf(bytes, 8192, "motus archive 1\ndirectory 4096 %016llx\n%s",
                 (unsigned long long)directory_hash(DIRECTORY_HASH, body, strlen(body)), body);
        assert_int_equal(reads(bytes, 8192), k == sizeof bad / sizeof *bad);
        free(bytes);
    }
}

static void saved_is(motus_archive *a, int back, const char *text)
{
    char *bytes;
    size_t length;
    assert_int_equal(motus_archive_saved(a, back, &bytes, &length, NULL), MOTUS_OK);
    if (!text) assert_null(bytes);
    if (text) assert_string_equal(bytes, text);
    assert_int_equal(length, text ? strlen(text) : 0);
    free(bytes);
}

static void change(const char *path, long at)
{
    FILE *file = fopen(path, "r+b");
    assert_int_equal(fseek(file, at, SEEK_SET), 0);
    const int byte = getc(file);
    fseek(file, at, SEEK_SET);
    putc(byte ^ 1, file);
    assert_int_equal(fclose(file), 0);
}

static char *bytes_of(const fixture *f)
{
    FILE *file = fopen(f->path, "rb");
    char *bytes = malloc(f->size + 1);
    assert_int_equal(fread(bytes, 1, f->size + 1, file), f->size);
    fclose(file);
    return bytes;
}

/* Two slots in turn; a byte that changes in one leaves the other. What was written before the last state leaves no
 * byte. */
static void states(void **state)
{
    const fixture *f = *state;
    motus_archive *a;
    directory d;
    size_t size, length;
    char text[SLOT], *last = NULL, *bytes;
    assert_int_equal(directory_read(&d, f->bytes, f->size, f->size, "it", &size, NULL), MOTUS_OK);
    const long slots = (long)d.slots_place;
    directory_free(&d);
    for (int count = 0; count < 6; count++) {
        write_file(f->path, f->bytes, f->size);
        assert_int_equal(motus_archive_open(f->path, 1, &a, NULL), MOTUS_OK);
        saved_is(a, 0, NULL);
        saved_is(a, 1, NULL);
        for (int k = 1; k <= count; k++) {
            memset(text, '.', sizeof text);
            snprintf(text + 50 * k, sizeof text - 50 * (size_t)k, "%d", k);
            assert_int_equal(motus_archive_save(a, text, strlen(text), NULL), MOTUS_OK);
            saved_is(a, 0, text);
            const long at = slots + k % 2 * (SLOT + DIRECTORY_SLOT) + (k % 3 == 0 ? 8 : k % 3 == 1 ? 20 : 40);
            change(f->path, at);
            assert_int_equal(motus_archive_saved(a, 0, &bytes, &length, NULL), MOTUS_OK);
            if (k == 1) assert_null(bytes);
            if (k > 1) assert_int_equal(atoi(bytes + 50 * (k - 1)), k - 1);
            free(bytes);
            change(f->path, at);
            saved_is(a, 0, text);
            if (k > 1) continue;
            saved_is(a, 1, NULL);
        }
        assert_int_equal(motus_archive_save(a, text, motus_archive_slot(a) + 1, NULL), MOTUS_LIMIT);
        assert_int_equal(motus_archive_settle(a, text, motus_archive_slot(a) + 1, NULL), MOTUS_LIMIT);
        assert_int_equal(motus_archive_settle(a, "the end", 7, NULL), MOTUS_OK);
        saved_is(a, 0, "the end");
        saved_is(a, 1, "the end");
        bytes = bytes_of(f);
        if (last) assert_memory_equal(bytes, last, f->size);
        free(last);
        last = bytes;
        assert_int_equal(motus_archive_save(a, "more", 4, NULL), MOTUS_OK);
        saved_is(a, 0, "more");
        saved_is(a, 1, "the end");
        motus_archive_close(a);
    }
    free(last);
    write_file(f->path, f->bytes, f->size);
}

/* Where there are no slots no state is written, not even one without bytes. */
static void no_states(void **state)
{
    static const char body[] = "rows 1\nblock 1\nnumber 4096 n\ndone 4104\ncolumn number 4112 x\nend\n";
    const fixture *f = *state;
    motus_archive *a;
    char bytes[8192] = "";
    snprintf(bytes, sizeof bytes, "motus archive 1\ndirectory 4096 %016llx\n%s",
             (unsigned long long)directory_hash(DIRECTORY_HASH, body, strlen(body)), body);
    write_file(f->path, bytes, sizeof bytes);
    assert_int_equal(motus_archive_open(f->path, 1, &a, NULL), MOTUS_OK);
    assert_int_equal(motus_archive_slot(a), 0);
    saved_is(a, 0, NULL);
    assert_int_equal(motus_archive_save(a, "", 0, NULL), MOTUS_LIMIT);
    assert_int_equal(motus_archive_settle(a, "", 0, NULL), MOTUS_LIMIT);
    motus_archive_close(a);
    FILE *file = fopen(f->path, "rb");
    char now[sizeof bytes];
    assert_int_equal(fread(now, 1, sizeof now, file), sizeof now);
    fclose(file);
    assert_memory_equal(now, bytes, sizeof bytes);
}

static void refusals(void **state)
{
    (void)state;
    motus_error err = motus_default_error();
    motus_archive *a = (motus_archive *)&err;
    assert_int_equal(motus_archive_open("/tmp", 0, &a, &err), MOTUS_FILE);
    assert_null(a);
    assert_int_equal(motus_archive_open("/absent/file.h5", 0, &a, &err), MOTUS_FILE);
    motus_archive_def d = definition();
    d.column_count = 0;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    d = definition(), d.block = 0;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    d = definition(), d.group = "a/b";
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    d = definition(), d.size = 0;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    motus_archive_column twice[2] = {{"a\nb", MOTUS_ARCHIVE_NUMBER, NULL, 0, {0, 0}, NULL},
                                     {"x", (motus_archive_kind)7, NULL, 0, {0, 0}, NULL}};
    d = definition(), d.columns = twice, d.column_count = 1;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    d.columns = twice + 1;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    const motus_archive_column lacking = {"w", MOTUS_ARCHIVE_WORD, NULL, 2, {0, 0}, NULL};
    d = definition(), d.columns = &lacking, d.column_count = 1;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    d = definition(), d.columns = NULL;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    d = definition(), d.notes = NULL;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    d = definition(), d.link_count = 1;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    d = definition(), d.attribute_count = 1;
    assert_int_equal(motus_archive_create("/absent/file.h5", &d, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_archive_create(NULL, &d, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_archive_create("/absent/file.h5", NULL, &err), MOTUS_ARGUMENT);
    assert_int_equal(motus_archive_open(NULL, 0, &a, &err), MOTUS_ARGUMENT);
    motus_archive_close(NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(says_what_was_said, begin, end),
        cmocka_unit_test_setup_teardown(blocks, begin, end),
        cmocka_unit_test_setup_teardown(every_byte_matters, begin, end),
        cmocka_unit_test(places_are_inside),
        cmocka_unit_test(shapes),
        cmocka_unit_test_setup_teardown(states, begin, end),
        cmocka_unit_test_setup_teardown(no_states, begin, end),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
