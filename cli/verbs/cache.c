/* motus cache: the compiled models kept between runs. */
#include "cli/words/complain.h"
#include "cli/words/text.h"
#include "cli/words/options.h"

#include <stdio.h>

motus_status cache_verb(const options *o, motus_error *err)
{
    if (o->operand || !o->clear)
        return complain(err, MOTUS_ARGUMENT, "motus cache --clear removes every entry",
                        o->operand ? "motus cache takes no model" : "motus cache needs --clear");
    int count = motus_cache_clear();
    if (count < 0) return fail(err, MOTUS_FILE, "cannot read the folder of the cache");
    if (o->json) {
        json j = text_json(stdout);
        json_integer(&j, "removed", count);
        json_end(&j);
    } else if (!o->quiet) {
        printf("%d compiled model%s removed\n", count, count == 1 ? "" : "s");
    }
    return MOTUS_OK;
}
