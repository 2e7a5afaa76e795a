/* How long the steps of a method may be for a rate of the motion. */
#ifndef API_WHY_STABILITY_H
#define API_WHY_STABILITY_H

/* The largest step times |rate| along the direction of a rate re + i im, up to which steps of the method do not grow;
 * 0: none. NaN: the shortest of them have no result, as where an iteration does not converge. */
double stability_bound(const char *method, double re, double im);

#endif
