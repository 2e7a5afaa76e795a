/* Limits on indices: the parser refuses more, and the graph has room for as many. */
#ifndef LANG_BASE_LIMITS_H
#define LANG_BASE_LIMITS_H

enum {
    MAX_DIMS = 4, /* indices of a family, and of one sum */
    MAX_LEVELS = 8
}; /* loops within one another */

#endif
