/* The plan of a row and the places of the arrays, by the functions of its family. */
#ifdef ROWS
/* Sizes and facts of the plan; with memory for work_plan_size numbers, which must stay, its constants too. row, velocity and linear must be set. */
static void work_plan(work *w, const double argument[2], coef *memory)
{
    w->carried = w->row->adaptive;
    family_plan(w, argument, NULL, NULL);
    if (!memory) return;
    coef *c = memory + work_constants(w);
    family_plan(w, argument, memory, c);
    w->unit = memory;
    w->c = c;
    w->scaled = c + w->stages;
    w->matrix = w->scaled + work_constants(w);
}
#endif

/* Gives every array its place in `memory`, and returns how many there are; memory NULL: counts alone. After work_plan. */
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
