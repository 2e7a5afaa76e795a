/* Characters of a text in UTF-8. */
#ifndef BASE_UTF8_H
#define BASE_UTF8_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* The number of bytes of the character at s, of which `length` may be read (of a text that ends with 0 any length will
 * do); 0 where the bytes are not UTF-8, nor are overlong forms and surrogates. */
size_t utf8_read(const char *s, size_t length, uint32_t *character);
/* Writes a character; returns its number of bytes. */
size_t utf8_write(uint32_t character, char out[4]);
/* Whether a character may reach a terminal: no control characters, none that turn the direction of writing. */
bool utf8_visible(uint32_t character);

#endif
