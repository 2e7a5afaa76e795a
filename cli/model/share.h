/* The fragment of a link to the lab: a model and the settings of a command, as data.
 *
 *     #v=1&m=<model>&s=<name=expression>&s=…&a=<method,method>&h=<step>&r=<tolerance>&T=<until>
 *
 * In this order; all but v, the version, are optional. Values are UTF-8, percent-encoded except A-Z a-z 0-9 - . _ ~
 * ( ) , * so that a fragment cannot end a quoted string of a shell or of HTML, where only & has to be escaped.
 */
#ifndef CLI_MODEL_SHARE_H
#define CLI_MODEL_SHARE_H

#include "cli/model/load.h"

#define SHARE_TEXT_MAX ((size_t)64 << 10) /* bytes of the model and the settings together, before they are encoded */

/* The fragment, from its # on; the caller frees *fragment. */
motus_status share_fragment(const load *, const options *, char **fragment, motus_error *);
/* file:// and an absolute path; NULL: out of memory. The caller frees it. */
char *share_file_url(const char *path);
/* run --share and compare --share: prints the fragment instead of computing. */
motus_status share_verb(const options *, motus_error *);

#endif
