/* How far the equations of a program reach, and so whether a family's cells can be advanced window by window.
 *
 * The outer index of a family is its first one. A program is divisible where every cell belongs to one outer index; it
 * is local where, besides, the acceleration at outer index i reads only the state at i - reach … i + reach.
 */
#ifndef LANG_EMIT_EMIT_LOCAL_H
#define LANG_EMIT_EMIT_LOCAL_H

#include "lang/graph/graph.h"

enum { LOCAL_REACH_MAX = 64 };

typedef struct locality {
    bool divisible, local;
    int64_t reach;
} locality;

locality emit_local(const program *);

#endif
