/* The words of the language, and the nearest word to a mistaken one. */
#ifndef LANG_WORDS_H
#define LANG_WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* The statement that a mistaken word may be meant for; false: none. */
bool words_nearest_statement(const char *name, char *out, size_t size);

#endif
