/* How the state of a model of neighbours lies in memory, by outer index; machine/tiles.c fills it, window.h and
 * tiled.h read it.
 *
 * A part is one component of one family: the numbers of outer index i are base + (i - first) stride … + stride - 1,
 * for `cells` indices. Parts follow one another in memory and cover the state; those with positions come first.
 * `still` lists, in order, the stretches of numbers that no equation moves (boundary cells, holes): pairs of begin
 * and end.
 */
typedef struct tiling_part {
    size_t base, stride, cells;
    whole first;
} tiling_part;

typedef struct tiling {
    const tiling_part *part;
    int parts, positions;
    const size_t *still;
    size_t stills;
    size_t numbers;    /* of x in one outer index, all parts: what a tile's size is reckoned by */
    whole first, last; /* outer indices of all parts */
    whole reach;       /* the acceleration at i reads i - reach … i + reach */
    whole around;      /* a window moves by so much before an acceleration, and after it: at least reach */
    whole pass;        /* … before a pass from one copy of x to the other */
} tiling;
