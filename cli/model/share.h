/* The fragment of a link to the lab: a model and the settings of a command, as data.
 *
 *     #v=1&m=<model>&s=<name=expression>&s=…&a=<method,method>&h=<step>&r=<tolerance>&T=<until>
 *
 * The items have this order; all but v, the version, are optional. Values are UTF-8, percent-encoded except A-Z a-z 0-9
 * - . _ ~ ( ) , * so that a fragment cannot end a quoted string in a shell or in HTML, where only & must be escaped.
 */
#ifndef CLI_MODEL_SHARE_H
#define CLI_MODEL_SHARE_H

#include "cli/model/load.h"

#define SHARE_TEXT_MAX ((size_t)64 << 10) /* bytes of the model and the settings together, before they are encoded */

/* Makes the fragment, from its # on; the caller frees *fragment. */
motus_status share_fragment(const load *, const options *, char **fragment, motus_error *);
/* Returns file:// and an absolute path; the caller frees it. NULL: out of memory. */
char *share_file_url(const char *path);
/* Prints the fragment, for `run --share` and `compare --share`. */
motus_status share_verb(const options *, motus_error *);

#endif
