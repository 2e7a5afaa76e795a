/* Definitions and words that need no system. */
#include "api/system.h"

#include <math.h>
#include <string.h>

#define COPY(type)                                                        \
    do {                                                                  \
        d.size = size;                                                    \
        memset(def, 0, size);                                             \
        memcpy(def, &d, size < sizeof d ? size : sizeof d);               \
    } while (0)

void motus_default(motus_def_kind kind, void *def, uint32_t size)
{
    switch (kind) {
    case MOTUS_DEF_ERROR: {
        motus_error d = {.time = NAN};
        COPY(motus_error);
        break;
    }
    case MOTUS_DEF_TEXT: {
        motus_text_def d = {.length = SIZE_MAX};
        COPY(motus_text_def);
        break;
    }
    case MOTUS_DEF_CALLBACK: {
        motus_callback_def d = {.depends_on_velocity = 1, .depends_on_time = 1};
        COPY(motus_callback_def);
        break;
    }
    case MOTUS_DEF_RUN: {
        motus_run_def d = {.step = NAN, .until = NAN, .start = NAN};
        COPY(motus_run_def);
        break;
    }
    case MOTUS_DEF_STUDY: {
        motus_study_def d = {.step = NAN, .until = NAN};
        COPY(motus_study_def);
        break;
    }
    case MOTUS_DEF_ENSEMBLE: {
        motus_ensemble_def d = {.step = NAN, .until = NAN, .every = 1};
        COPY(motus_ensemble_def);
        break;
    }
    }
}

const char *motus_version(void) { return MOTUS_VERSION; }

static const struct { const char *word, *text; int exit; } statuses[] = {
#define X(name, word, text, exit) {word, text, exit},
    MOTUS_STATUS_MAP(X)
#undef X
};

static size_t known(motus_status s) { return (unsigned)s < MOTUS_STATUS_COUNT ? (size_t)s : MOTUS_ARGUMENT; }

const char *motus_status_word(motus_status s) { return statuses[known(s)].word; }
const char *motus_status_text(motus_status s) { return statuses[known(s)].text; }
int motus_status_exit(motus_status s) { return statuses[known(s)].exit; }
