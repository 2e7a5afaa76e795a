/* How far the indices of a model go: the parser refuses more, and the graph's structures have room for this many. */
#ifndef LANG_BASE_LIMITS_H
#define LANG_BASE_LIMITS_H

enum { MAX_DIMS = 4,                 /* indices of a family, and of one sum */
       MAX_LEVELS = 8 };             /* loops within one another */

#endif
