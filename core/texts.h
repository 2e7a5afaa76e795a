/* The texts of step/ in their order, with every family. The includer first defines the macros and functions that work.h
 * lists. No operation on the state is written here, so all includers compute the same bits. */
#define BLURS(w) ((w)->blur != NULL)
#include "step/norm.h"
#include "step/control.h"
#include "step/density.h"
#include "step/judge.h"
#include "step/newton.h"
#include "step/operators.h"
#include "step/tableau.h"
#include "step/swing.h"
#include "step/dense.h"
#include "step/lift.h"
#include "step/pair.h"
#include "step/collocation.h"
#include "step/continuous.h"
#include "step/extrapolation.h"
#define FAMILY_TEXTS
#include "step/families.def"
#undef FAMILY_TEXTS
#include "core/family.h"
#include "step/plan.h"
#include "step/advance.h"
#include "step/observe.h"
#include "step/watch.h"
#include "step/loop.h"
#include "step/branch.h"
