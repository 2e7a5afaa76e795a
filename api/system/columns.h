/* The columns of one name, shared by columns.c (numbering, values) and column_names.c (names). */
#ifndef API_SYSTEM_COLUMNS_H
#define API_SYSTEM_COLUMNS_H

#include "api/system/system.h"

/* The name of the time, the first column. */
static inline const char *columns_time(const motus_system *s) { return s->model ? s->model->time : "t"; }
static inline size_t columns_parts(int components) { return components ? (size_t)components : 1; }

const column_range *columns_range(const motus_system *, size_t k);
/* Returns name, cells and components of a range's columns: the state, or the definition written as a state. */
model_state columns_shape(const motus_system *, const column_range *);
/* Finds the cell with these indices. False: no equation is there. */
bool columns_find_cell(const model_state *, const int64_t *index, size_t *cell);
/* Enters the names of all ranges into the table by which motus_column_find finds them. False: no memory. */
bool column_names_enter(motus_system *);
/* Writes the name of the time into a sentence, "at tau = 3", where the model does not name it t. */
void column_names_time(const motus_system *, char *sentence, size_t size);
static inline void column_names_error(const motus_system *s, motus_error *err)
{
    if (err) column_names_time(s, err->message, sizeof err->message);
    if (err) column_names_time(s, err->hint, sizeof err->hint);
}
/* Reports that the callback for `which` returned `answer` at time t. Returns MOTUS_CALLBACK. */
motus_status columns_callback_failed(const char *which, double t, int answer, motus_error *);

#endif
