/* The functions of families.def, each by a switch over the row's family. A compiled model calls the functions of its
 * family directly instead. */
#define FAMILY_SWITCH(CASE)   \
    switch (w->row->family) { \
        FAMILIES(CASE)        \
    }
#define FAMILY_RETURN(CASE, otherwise) FAMILY_SWITCH(CASE) return otherwise;

#define CASE_PLAN(NAME, name, shared, facts) \
    case NAME: name##_plan(w, argument, unit, c); break;
static inline void family_plan(work *w, const double argument[2], coef *unit, coef *c) { FAMILY_SWITCH(CASE_PLAN) }

/* Families may share a function. NOLINTBEGIN(bugprone-branch-clone) */
#define CASE_PLACE(NAME, name, shared, facts) \
    case NAME: name##_place(w, p); break;
static inline void family_place(work *w, placing *p) { FAMILY_SWITCH(CASE_PLACE) }

#define CASE_STEP(NAME, name, shared, facts) \
    case NAME: return name##_step(w);
static inline int family_step(work *w) { FAMILY_RETURN(CASE_STEP, STEP_OK) }

#define CASE_ACCEPT(NAME, name, shared, facts) \
    case NAME: name##_accept(w, good); break;
static inline void family_accept(work *w, clock_mask good) { FAMILY_SWITCH(CASE_ACCEPT) }

#define CASE_OBSERVE(NAME, name, shared, facts) \
    case NAME: return name##_observe(w);
static inline int family_observe(work *w) { FAMILY_RETURN(CASE_OBSERVE, STEP_OK) }

#define CASE_SYNC(NAME, name, shared, facts) \
    case NAME: return name##_sync(w, x, v);
static inline int family_sync(work *w, real *x, real *v) { FAMILY_RETURN(CASE_SYNC, STEP_OK) }

#define CASE_CARRY(NAME, name, shared, facts) \
    case NAME: return name##_carry(w, list);
static inline int family_carry(const work *w, real *list[CARRY_MAX]) { FAMILY_RETURN(CASE_CARRY, 0) }

#define CASE_BETWEEN(NAME, name, shared, facts) \
    case NAME: return name##_between(w, unit);
static inline dense_room family_between(const work *w, coef *unit) { FAMILY_RETURN(CASE_BETWEEN, (dense_room){0}) }

#define CASE_EXTEND(NAME, name, shared, facts) \
    case NAME: return name##_extend(w, d);
static inline int family_extend(work *w, const dense_step *d) { FAMILY_RETURN(CASE_EXTEND, STEP_OK) }

#define CASE_DENSE(NAME, name, shared, facts) \
    case NAME: return name##_dense(w, d, t, x, v);
static inline int family_dense(work *w, const dense_step *d, clock t, real *x, real *v)
{
    FAMILY_RETURN(CASE_DENSE, STEP_OK)
}

#define CASE_SWING(NAME, name, shared, facts) \
    case NAME: return name##_swing(w, most);
static inline bool family_swing(const work *w, real *most) { FAMILY_RETURN(CASE_SWING, false) }

#ifdef TRACING
#define CASE_ROOM(NAME, name, shared, facts) \
    case NAME: return name##_room(w);
static inline trace_room family_room(const work *w) { FAMILY_RETURN(CASE_ROOM, (trace_room){0}) }

#define CASE_TRACE(NAME, name, shared, facts) \
    case NAME: name##_trace(w, i); break;
static inline void family_trace(work *w, int i) { FAMILY_SWITCH(CASE_TRACE) }
#endif
/* NOLINTEND(bugprone-branch-clone) */
