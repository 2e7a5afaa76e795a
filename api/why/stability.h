/* How long the steps of a method may be for a rate of the motion. */
#ifndef API_WHY_STABILITY_H
#define API_WHY_STABILITY_H

/* Returns the largest product of step and |rate| for which steps of the method do not grow, along the direction of a
 * rate re + i im. 0: they always grow. NaN: even the shortest steps have no result, as where an iteration fails to
 * converge. */
double stability_bound(const char *method, double re, double im);

#endif
