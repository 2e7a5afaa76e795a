/* qsort and strstr, instead of the C library's, which are fast for long arrays and texts that the library has not.
 *
 * Invariant: qsort takes time n log n at worst, since it sorts a heap.
 */
#include <stdlib.h>
#include <string.h>

static void swap(char *a, char *b, size_t size)
{
    for (; size; size--, a++, b++) {
        const char held = *a;
        *a = *b;
        *b = held;
    }
}

void qsort(void *base, size_t count, size_t size, int (*compare)(const void *, const void *))
{
    char *const at = base;
    /* first each element from the middle down sinks to its place in the heap, then the one that replaces the largest */
    for (size_t start = count / 2, end = count; end > 1;) {
        if (start > 0)
            start--;
        else
            swap(at, at + --end * size, size);
        for (size_t k = start, child; (child = 2 * k + 1) < end; k = child) {
            if (child + 1 < end && compare(at + child * size, at + (child + 1) * size) < 0) child++;
            if (compare(at + k * size, at + child * size) >= 0) break;
            swap(at + k * size, at + child * size, size);
        }
    }
}

char *strstr(const char *text, const char *part)
{
    const size_t length = strlen(part);
    for (; *text; text++)
        if (!strncmp(text, part, length)) return (char *)text;
    return length ? NULL : (char *)text;
}
