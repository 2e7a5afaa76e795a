/* The similarity of two words, by the edits that lead from one to the other; no part is edited twice.
 *
 * Invariant: a word counts by its first 64 characters; bytes that are not UTF-8 count as characters.
 */
#include "base/near.h"

#include "base/utf8.h"

#include <stdio.h>

enum { LETTERS = 64 };

static int letters(const char *text, uint32_t out[LETTERS])
{
    int n = 0;
    for (size_t size; *text && n < LETTERS; text += size, n++) {
        size = utf8_read(text, SIZE_MAX, &out[n]);
        if (size == 0) {
            out[n] = (unsigned char)*text;
            size = 1;
        }
    }
    return n;
}

/* Maps characters that look alike to one character. */
static uint32_t face(uint32_t c)
{
    static const uint32_t twins[][2] = {{0xB5, 0x3BC},  {0x2126, 0x3A9}, {0x212B, 0xC5},  {0x3B5, 0x3F5},
                                        {0x3D5, 0x3C6}, {0x3D1, 0x3B8},  {0x210F, 0x127}, {0x430, 'a'},
                                        {0x435, 'e'},   {0x43E, 'o'},    {0x440, 'p'},    {0x441, 'c'},
                                        {0x445, 'x'},   {0x443, 'y'},    {0x3BD, 'v'},    {0x3BF, 'o'}};
    for (size_t i = 0; i < sizeof twins / sizeof *twins; i++)
        if (c == twins[i][0]) return twins[i][1];
    return c;
}

static uint32_t lower(uint32_t c)
{
    if (c >= 'A' && c <= 'Z') return c + 32;
    if (c >= 0x391 && c <= 0x3A9) /* Greek capitals */
        return c + 32;
    return c;
}

static int cost(uint32_t a, uint32_t b) { return a == b ? 0 : lower(face(a)) == lower(face(b)) ? 1 : 2; }

int near_distance(const char *first, const char *second, int limit)
{
    uint32_t a[LETTERS], b[LETTERS];
    int n = letters(first, a), m = letters(second, b);
    if (n - m > limit || m - n > limit) return limit + 1;
    int row[3][LETTERS + 1];
    for (int j = 0; j <= m; j++) row[0][j] = 2 * j;
    for (int i = 1; i <= n; i++) {
        int *now = row[i % 3], *before = row[(i + 2) % 3], *earlier = row[(i + 1) % 3];
        now[0] = 2 * i;
        for (int j = 1; j <= m; j++) {
            int best = before[j - 1] + cost(a[i - 1], b[j - 1]);
            if (before[j] + 2 < best) best = before[j] + 2;
            if (now[j - 1] + 2 < best) best = now[j - 1] + 2;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && earlier[j - 2] + 2 < best)
                best = earlier[j - 2] + 2;
            now[j] = best;
        }
    }
    return row[n % 3][m];
}

bool near_likely(const char *a, const char *b)
{
    uint32_t buffer[LETTERS];
    int n = letters(a, buffer);
    int allowed = n <= 1 ? 1 : n <= 4 ? 2 : n <= 8 ? 4 : 6;
    return near_distance(a, b, allowed) <= allowed;
}

bool near_nearer(const char *a, const char *b, int *least)
{
    const int distance = near_likely(a, b) ? near_distance(a, b, *least) : *least;
    if (distance >= *least) return false;
    *least = distance;
    return true;
}

bool near_look_alike(const char *first, const char *second, char *out, size_t size)
{
    uint32_t a[LETTERS], b[LETTERS];
    int n = letters(first, a), m = letters(second, b);
    if (n != m) return false;
    int different = -1;
    for (int i = 0; i < n; i++) {
        if (face(a[i]) != face(b[i])) return false;
        if (a[i] != b[i] && different < 0) different = i;
    }
    if (different < 0) return false;
    snprintf(out, size, "U+%04X against U+%04X", a[different], b[different]);
    return true;
}
