/* The memory layout of the state of a model of neighbours, by outer index. machine/tiles.c writes it; window.h, pass.h
 * and tiled.h read it.
 *
 * A part is one component of one family: the numbers of outer index i are base + (i - first) stride … + stride - 1,
 * for `cells` indices. Parts follow one another in memory and cover the state; those with positions come first.
 * `fixed` lists, in order, the ranges of fixed cells (boundary cells, holes), which no equation moves: pairs of begin
 * and end.
 */
typedef struct tiling_part {
    size_t base, stride, cells;
    whole first;
} tiling_part;

typedef struct tiling {
    const tiling_part *part;
    int parts, positions;
    const size_t *fixed;
    size_t fixed_count; /* ranges */
    size_t numbers;     /* of x in one outer index, all parts; decides the size of a tile */
    whole first, last;  /* outer indices of all parts */
    whole reach;        /* the acceleration at i reads i - reach … i + reach */
    whole around;       /* how far a window moves before an acceleration, and after it: at least reach */
    whole pass;         /* and before a pass from one copy of x to the other */
} tiling;
