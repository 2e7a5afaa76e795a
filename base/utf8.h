/* Characters of a text in UTF-8. */
#ifndef BASE_UTF8_H
#define BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Reads the character at s, of which `length` bytes may be read (of a text that ends with 0 any length will do).
 * Returns its bytes; 0: they are not UTF-8, an overlong form or a surrogate. */
size_t utf8_read(const char *s, size_t length, uint32_t *character);
/* Writes a character, and returns its number of bytes. */
size_t utf8_write(uint32_t character, char out[4]);
/* Returns whether a character may reach a terminal: it neither controls it nor turns the direction of writing. */
bool utf8_visible(uint32_t character);

#endif
