/* The floating-point modes that a caller may have changed: saved, set to IEEE defaults, restored. */
#include "base/modes.h"

#include <fenv.h>

#if defined(__x86_64__) || defined(__SSE__)
#include <xmmintrin.h>
enum { FLUSHES = 0x8040 }; /* flush to zero, denormals are zero */
static unsigned long control(void) { return _mm_getcsr(); }
static void set_control(unsigned long c) { _mm_setcsr((unsigned)c); }
#elif defined(__aarch64__)
enum { FLUSHES = 1 << 24 };
static unsigned long control(void)
{
    unsigned long c;
    __asm__ volatile("mrs %0, fpcr" : "=r"(c));
    return c;
}
static void set_control(unsigned long c) { __asm__ volatile("msr fpcr, %0" : : "r"(c)); }
#else
enum { FLUSHES = 0 };
static unsigned long control(void) { return 0; }
static void set_control(unsigned long c) { (void)c; }
#endif

modes modes_enter(void)
{
    modes m = {fegetround(), control()};
    if (m.rounding != FE_TONEAREST) fesetround(FE_TONEAREST);
    if (m.control & FLUSHES) set_control(control() & ~(unsigned long)FLUSHES);
    return m;
}

void modes_leave(modes m)
{
    if (m.rounding != FE_TONEAREST) fesetround(m.rounding);
    if (m.control & FLUSHES) set_control(control() | (m.control & FLUSHES));
}
