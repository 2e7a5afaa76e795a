/* The definitions that step/observe.h and reduce.h expect, for lanes. */
#if DRIVEN
#define refresh_at(w, t, x, v) BOUNDARY(w->host, t, x, v, (real *)0)
#else
#define refresh_at(w, t, x, v) ((void)0)
#endif
#define LEAST(a, b) OF_LANES(min)(a, b)
#define MOST(a, b) OF_LANES(max)(a, b)
