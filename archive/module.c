/* The functions of the module that knows HDF5. See make.h. */
#include "archive/make.h"

#include <dlfcn.h>

void *module_find(const char *name)
{
    void *const module = dlopen(MAKE_MODULE, RTLD_LAZY | RTLD_LOCAL);
    return module ? dlsym(module, name) : NULL;
}
