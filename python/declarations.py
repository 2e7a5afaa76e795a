"""The C declarations of motus, made from its public headers, so that none stands twice."""
import re
import subprocess

HEADERS = ("motus.h",)

# What C calls in Python. `cffi` takes the GIL for them, and gives it up in every call to C.
CALLBACKS = """
extern "Python" int motus_python_progress(void *, double);
extern "Python" int motus_python_acceleration(void *, double, const double *, const double *, double *);
extern "Python" int motus_python_block(void *, size_t, size_t, double, const double *, const double *, double *);
extern "Python" int motus_python_functions(void *, double, const double *, const double *, double *);
"""


def declarations(include, compiler="cc"):
    """Returns the declarations of the public headers in the folder `include`, as cffi reads them."""
    text = ""
    for header in HEADERS:
        with open(f"{include}/{header}", encoding="utf-8") as file:
            text += re.sub(r"^#include.*$", "", file.read(), flags=re.M)
    plain = subprocess.run([compiler, "-E", "-P", "-x", "c", "-"], input=text, text=True, check=True,
                           stdout=subprocess.PIPE).stdout
    # The text that C sees has the bodies of inline functions; cffi calls them as functions.
    return re.sub(r"static inline ([^{;]*)\{[^}]*\}", r"\1;", plain)


def source():
    """Returns what stands before the code that cffi makes."""
    return "".join(f"#include <{header}>\n" for header in HEADERS)
