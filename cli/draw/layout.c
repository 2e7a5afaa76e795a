/* Where the panels of a figure lie.
 *
 * Invariant: the axes of the panels in a column have one width and stand one below another. Beside them is room for the
 * widest key, so that a key hides nothing.
 */
#include "cli/draw/plot.h"

#include "cli/words/text.h"

#include <string.h>

enum {
    LEFT = 96,    /* for the numbers and the name of the vertical axis */
    ABOVE = 30,   /* for the title */
    BELOW = 66,   /* for the numbers and the name of the horizontal axis */
    TOP = 38,     /* for the figure's title */
    RIGHT = 44,   /* without a key */
    SCALE = 140,  /* of the colours beside a map, with its name */
    LETTER = 9,   /* the mean width of one */
    LINE = 19,    /* of a key */
    SAMPLE = 96,  /* of a line in a key, and what is beside it */
    LONGEST = 32, /* letters of a label in a key */
    MANY = 5      /* panels in one column, at most */
};

void layout_label(const char *label, char out[PLOT_LABEL])
{
    text_safe(label, out, PLOT_LABEL);
    for (size_t n = strlen(out); n > 0 && text_width(out) > LONGEST; n--) out[n - 1] = 0;
}

/* Returns how many lines a key has. It has none for a single curve, which the axis names. */
static size_t key_lines(const plot_panel *p, size_t *widest)
{
    size_t lines = 0;
    bool band = false;
    *widest = 5; /* "error" */
    for (size_t k = 0; k < p->curve_count; k++) {
        const plot_curve *c = &p->curves[k];
        char label[PLOT_LABEL];
        bool again = false;
        for (size_t i = 0; i < k; i++)
            again = again || (p->curves[i].role == c->role && strcmp(p->curves[i].label, c->label) == 0);
        band = band || data_band(p, c);
        if (again || data_none(c)) continue;
        layout_label(c->label, label);
        lines++;
        *widest = text_width(label) > *widest ? text_width(label) : *widest;
    }
    return lines + band < 2 ? 0 : lines + band;
}

/* Returns the room beside a panel. */
static int beside(const plot_panel *p)
{
    size_t widest;
    if (p->heat || p->shade_label[0]) return SCALE;
    return key_lines(p, &widest) ? SAMPLE + (int)widest * LETTER : RIGHT;
}

static int height_of(const plot_figure *f, size_t i)
{
    const plot_panel *p = &f->panels[i];
    const bool alone = f->count == 1, solid = p->curve_count && p->curves[0].z;
    size_t widest;
    int height = alone ? 380 : 240;
    if (p->low) height = 110;
    if (p->path || p->equal) height = alone ? 560 : 440;
    if (alone && p->curve_count && p->curves[0].role == PLOT_POINTS) height = 560;
    if (p->heat) height = alone ? 460 : 320;
    if (p->logarithmic) height = 520;
    if (solid) height = 520;
    const int key = f->one_key && i > 0 ? 0 : (int)key_lines(p, &widest) * LINE;
    return height > key ? height : key;
}

layout layout_make(const plot_figure *f)
{
    layout l = {0};
    const size_t columns = f->count > MANY && !f->one_key ? 2 : 1;
    const double wide = columns > 1 ? 560 : 760;
    double left = LEFT;
    for (size_t c = 0; c < columns; c++) {
        int most = 0;
        for (size_t i = c; i < f->count; i += columns)
            most = beside(&f->panels[i]) > most ? beside(&f->panels[i]) : most;
        for (size_t i = c; i < f->count; i += columns) {
            size_t widest;
            const bool key = key_lines(&f->panels[i], &widest) > 0 && (!f->one_key || i == 0);
            l.boxes[i] = (layout_box){.left = left, .width = wide, .key = key ? left + wide + 14 : 0};
        }
        left += wide + most;
        l.width = (int)left;
        left += LEFT;
    }
    double top = TOP;
    for (size_t i = 0; i < f->count; i += columns) {
        int high = 0;
        for (size_t k = i; k < i + columns && k < f->count; k++) high = height_of(f, k) > high ? height_of(f, k) : high;
        for (size_t k = i; k < i + columns && k < f->count; k++) {
            l.boxes[k].top = top + ABOVE;
            l.boxes[k].height = high;
        }
        top += ABOVE + high + BELOW;
    }
    l.height = (int)top + 6;
    return l;
}
