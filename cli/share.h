/* The fragment of an address of the lab: a model and what a command says beyond it, as data.
 *
 *     #v=1&m=<model>&s=<name=expression>&s=…&a=<method,method>&h=<step>&T=<until>
 *
 * In this order; only v, the version, is always there. Values are UTF-8, percent-encoded but for A-Z a-z 0-9 - . _ ~
 * ( ) , * so that a fragment can leave neither the quotes of a shell nor those of HTML, where & alone has to be
 * written &amp;.
 */
#ifndef CLI_SHARE_H
#define CLI_SHARE_H

#include "cli/load.h"

#define SHARE_TEXT_MAX ((size_t)64 << 10) /* bytes of the model and the settings together, before they are encoded */

/* The fragment, from its # on; the caller frees *fragment. */
motus_status share_fragment(const load *, const options *, char **fragment, motus_error *);
/* file:// and an absolute path; NULL: out of memory. The caller frees it. */
char *share_file_url(const char *path);
/* run --share and compare --share: the fragment in place of the computation. */
motus_status share_verb(const options *, motus_error *);

#endif
