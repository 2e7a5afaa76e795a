/* Groups of columns, for those who number them and those who read their names. */
#ifndef API_COLUMNS_H
#define API_COLUMNS_H

#include "api/system.h"

static inline size_t columns_parts(int components) { return components ? (size_t)components : 1; }

/* The group that column k is in. */
const column_group *columns_group(const motus_system *, size_t k);
/* The cells and components that a group's columns run over, and its name: the state's, or the definition as a state. */
model_state columns_shape(const motus_system *, const column_group *);
/* The cell with these indices; false if there is no equation there. */
bool columns_find_cell(const model_state *, const int64_t *index, size_t *cell);
/* MOTUS_CALLBACK: the callback for `which` returned `answer` at this time. */
motus_status columns_callback_failed(const char *which, double t, int answer, motus_error *);

#endif
