/* Errors: fail(err, MOTUS_…, "what, where") and hint(err, "what to do").
 *
 * The error may be NULL. The texts are made safe for a terminal, and their numbers have a decimal point in every
 * locale.
 */
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include "motus.h"

/* Fills the error and returns its status. */
motus_status fail(motus_error *, motus_status, const char *format, ...) __attribute__((format(printf, 3, 4)));
void hint(motus_error *, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Writes a text with decimal points in every locale, as in messages. */
void error_text(char out[MOTUS_TEXT_MAX], const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Notes the wrong word, and what to write instead: motus_error. */
void error_repair(motus_error *, const char *word, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
