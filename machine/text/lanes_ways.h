/* The definitions that reduce.h expects, for lanes. */
#define LEAST(a, b) OF_LANES(min)(a, b)
#define MOST(a, b) OF_LANES(max)(a, b)
