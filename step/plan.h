/* The plan of a row, and the places of the arrays, by the functions of its family. */
#ifdef ROWS
/* Sizes and facts of the plan; with memory for work_plan_size numbers, which the caller keeps, its constants too. row,
 * velocity and linear must be set. */
static void work_plan(work *w, const double argument[2], coef *memory)
{
    w->carried = w->row->adaptive;
    family_plan(w, argument, NULL, NULL);
    if (!memory) return;
    const size_t constants = work_constants(w);
    coef *c = memory + constants;
    unsigned char *live = (unsigned char *)(c + w->stages);
    family_plan(w, argument, memory, c);
    for (size_t k = 0; k < constants; k++) live[k] = memory[k] != 0;
    w->unit = memory;
    w->c = c;
    w->live = live;
    w->scaled = c + w->stages + work_live_size(w);
    w->matrix = w->scaled + w->linears + w->squares;
}
#endif

/* Gives every array its place in `memory`, and returns how many there are; memory NULL: counts alone. After
 * work_plan. */
static size_t work_place(work *w, real *memory)
{
    placing p = {memory, w->stride, 0};
    w->x = work_array(&p, 1);
    w->v = work_array(&p, 1);
    w->a = work_array(&p, 1);
    if (ROW(w, compensated)) w->ex = work_array(&p, 1), w->ev = work_array(&p, 1);
    family_place(w, &p);
    return p.used;
}
