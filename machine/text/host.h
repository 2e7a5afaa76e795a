/* What a compiled model is given by the library; machine/compiled.c fills it, and the workspace's `user` leads to it.
 *
 * pool, q, u: parameters; sizes, strides and bounds; numbers that depend on parameters alone.
 */
struct compiled_host {
    const double *pool, *u;
    const int64_t *q;
    /* of lanes: the pool of each trajectory, and the numbers that depend on it alone; of one trajectory `own` is room
     * for the sums over pairs, or NULL */
    real *own, *bound;
    struct solving *solving;         /* of lanes: their linear systems */
    real *lost;                      /* of lanes: those that could not solve their systems, or cannot go on */
    bool begins;                     /* of lanes with clocks of their own: every lane is at the first step of its leg */
    bool factored;                   /* of lanes: constant matrices are factored */
    int (*run)(work *, whole steps); /* the library's own loop */
    int (*factor)(work *, mask *where, int s, const clock *ax, const clock *av, clock t, real *x, real *v);
    void (*back)(work *, real *r);
    void (*apply)(work *, clock c, const real *y, real *out);
    /* the factored matrix, if it is diagonal and constant; else NULL */
    const real *(*diagonal)(const work *);
    int (*accel)(work *, clock t, real *x, real *v, real *a);
    const struct tiling *tiling; /* of families whose outer indices can be divided; else NULL */
    /* parallel_pool_for and the pool of threads for it */
    struct parallel_pool *thread_pool;
    void (*parallel)(struct parallel_pool *, int threads, size_t items,
                     void (*body)(void *ctx, size_t item, int thread), void *ctx);
};
typedef struct compiled_host compiled_host;
