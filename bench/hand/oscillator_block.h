/* The oscillators U registers at a time, of which S go through a step side by side; included once for each (U, S).
 *
 * Why they are fast. A trajectory's step waits for the step before: 15 to 20 cycles of latency for five operations,
 * where the machine could start two a cycle. So U registers of trajectories advance together, enough to fill that
 * wait; for each only x or v must stay in a register, the rest comes from the first cache as operands. The block runs
 * through all steps before the next one starts, so memory is touched once. The drive depends on time alone and is one
 * broadcast a step. With S > 1 the stages of a step are interleaved in the program, because a processor looks ahead
 * over one or two hundred instructions, not over a whole step of Runge-Kutta for all of them.
 */
#define JOIN_(name, u, s) name##_##u##_##s
#define JOIN(name, u, s) JOIN_(name, u, s)
#define BLOCK(name) static void JOIN(name, U, S)(const oscillators *o, size_t at)
#define EACH UNROLL for (int u = 0; u < U; u++)
#define EACH_GROUP UNROLL for (int g = 0; g < U; g += S)
#define EACH_IN_GROUP UNROLL for (int s = 0, u = g; s < S; s++, u++)
/* What is before and after the loop is none of the loop's business: else the compiler carries over from step to step
 * what it needs there. */
#define SEAL(array) \
    EACH            \
    KEEP(array[u])
#define F_OF(u) vec_load(o->F + at + (size_t)(u)*WIDTH)
#define STORE(array, u, value) vec_store(o->array + at + (size_t)(u)*WIDTH, value)

/* Our operations in our order: x³ as (x x) x, minus x, plus F cos t, each with one rounding where it is one
 * operation. */
#define FORCE(x, F, c) vec_fma(F, c, vec_fms((x) * (x), x, x))

BLOCK(verlet)
{
    double h = o->step;
    vec hh = vec_all(h * h), half_hh = vec_all(h * h / 2), c = vec_all(o->whole[0]);
    vec x[U], d[U];
    EACH {
        x[u] = vec_all(o->x0);
        d[u] = vec_fma(half_hh, FORCE(x[u], F_OF(u), c), vec_all(h) * vec_all(o->v0));
        x[u] += d[u];
    }
    SEAL(x);
    for (int64_t n = 1; n < o->steps; n++) {
        c = vec_all(o->whole[n]);
        EACH {
            d[u] = vec_fma(hh, FORCE(x[u], F_OF(u), c), d[u]);
            x[u] += d[u];
        }
    }
    SEAL(x);
    c = vec_all(o->whole[o->steps]);
    EACH {
        STORE(x, u, x[u]);
        STORE(v, u, vec_fma(half_hh, FORCE(x[u], F_OF(u), c), d[u]) * vec_all(1 / h));
    }
}

/* The closing kick of a step and the opening kick of the next are one. */
BLOCK(velocity_verlet)
{
    vec h = vec_all(o->step), half_h = vec_all(0.5 * o->step), kick = half_h, c;
    vec x[U], v[U];
    EACH
        x[u] = vec_all(o->x0), v[u] = vec_all(o->v0);
    SEAL(x);
    for (int64_t n = 0; n < o->steps; n++, kick = h) {
        c = vec_all(o->whole[n]);
        EACH {
            v[u] = vec_fma(kick, FORCE(x[u], F_OF(u), c), v[u]);
            x[u] = vec_fma(h, v[u], x[u]);
        }
    }
    SEAL(x);
    c = vec_all(o->whole[o->steps]);
    EACH {
        STORE(x, u, x[u]);
        STORE(v, u, vec_fma(half_h, FORCE(x[u], F_OF(u), c), v[u]));
    }
}

/* Our operations in our order: the velocities of the stages are eliminated. Sums over stages come first, h multiplies
 * them, and the state takes them once. */
BLOCK(rk4)
{
    vec h = vec_all(o->step), half = vec_all(0.5 * o->step), hh = vec_all(o->step * o->step), quarter = vec_all(0.25),
        two = vec_all(0.5), sixth = vec_all(1.0 / 6), third = vec_all(1.0 / 3);
    vec x[U], v[U];
    EACH
        x[u] = vec_all(o->x0), v[u] = vec_all(o->v0);
    SEAL(x);
    for (int64_t n = 0; n < o->steps; n++) {
        vec c0 = vec_all(o->whole[n]), c1 = vec_all(o->half[n]), c2 = vec_all(o->whole[n + 1]);
        EACH_GROUP
        {
            vec X[S], A[S], sum_x[S], sum_v[S], before[S];
            EACH_IN_GROUP
            {
                before[s] = FORCE(x[u], F_OF(u), c0);
                sum_x[s] = sixth * before[s];
                sum_v[s] = sum_x[s];
                X[s] = vec_fma(half, v[u], x[u]);
            }
            EACH_IN_GROUP
            {
                A[s] = FORCE(X[s], F_OF(u), c1);
                sum_x[s] = vec_fma(sixth, A[s], sum_x[s]);
                sum_v[s] = vec_fma(third, A[s], sum_v[s]);
                X[s] = vec_fma(hh, quarter * before[s], X[s]);
                before[s] = A[s];
            }
            EACH_IN_GROUP
            {
                A[s] = FORCE(X[s], F_OF(u), c1);
                sum_x[s] = vec_fma(sixth, A[s], sum_x[s]);
                sum_v[s] = vec_fma(third, A[s], sum_v[s]);
                X[s] = vec_fma(hh, two * before[s], vec_fma(h, v[u], x[u]));
            }
            EACH_IN_GROUP
            {
                A[s] = FORCE(X[s], F_OF(u), c2);
                x[u] += vec_fma(h, v[u], hh * sum_x[s]);
                v[u] += h * vec_fma(sixth, A[s], sum_v[s]);
            }
        }
    }
    SEAL(x);
    EACH {
        STORE(x, u, x[u]);
        STORE(v, u, v[u]);
    }
}

/* The same method for the system of first order, in which positions and velocities are alike: eight more sums. */
BLOCK(first_rk4)
{
    vec h = vec_all(o->step), half = vec_all(0.5 * o->step), b0 = vec_all(1.0 / 6 * o->step),
        b1 = vec_all(1.0 / 3 * o->step);
    vec x[U], v[U];
    EACH
        x[u] = vec_all(o->x0), v[u] = vec_all(o->v0);
    SEAL(x);
    for (int64_t n = 0; n < o->steps; n++) {
        vec c0 = vec_all(o->whole[n]), c1 = vec_all(o->half[n]), c2 = vec_all(o->whole[n + 1]);
        EACH_GROUP
        {
            vec X[S], V[S], A[S], sum_x[S], sum_v[S];
            EACH_IN_GROUP
            {
                A[s] = FORCE(x[u], F_OF(u), c0);
                sum_x[s] = b0 * v[u];
                sum_v[s] = b0 * A[s];
                X[s] = x[u] + half * v[u];
                V[s] = v[u] + half * A[s];
            }
            EACH_IN_GROUP
            {
                A[s] = FORCE(X[s], F_OF(u), c1);
                sum_x[s] = vec_fma(b1, V[s], sum_x[s]);
                sum_v[s] = vec_fma(b1, A[s], sum_v[s]);
                X[s] = x[u] + half * V[s];
                V[s] = v[u] + half * A[s];
            }
            EACH_IN_GROUP
            {
                A[s] = FORCE(X[s], F_OF(u), c1);
                sum_x[s] = vec_fma(b1, V[s], sum_x[s]);
                sum_v[s] = vec_fma(b1, A[s], sum_v[s]);
                X[s] = x[u] + h * V[s];
                V[s] = v[u] + h * A[s];
            }
            EACH_IN_GROUP
            {
                A[s] = FORCE(X[s], F_OF(u), c2);
                x[u] += vec_fma(b0, V[s], sum_x[s]);
                v[u] += vec_fma(b0, A[s], sum_v[s]);
            }
        }
    }
    SEAL(x);
    EACH {
        STORE(x, u, x[u]);
        STORE(v, u, v[u]);
    }
}

/* The same leapfrog for fewer operations. With y = h x and w = h² v, between the steps, its step is w += y (y² - h²)
 * + h³ F c; y += w: three fused operations and an addition, where the plain order takes four and one, or five. */
#define FREE_FORCE(y, drive) vec_fma(y, vec_fms(y, y, hh), drive)

BLOCK(free_leapfrog)
{
    double h = o->step;
    vec hh = vec_all(h * h), hhh = vec_all(h * h * h), half = vec_all(0.5), c = vec_all(o->whole[0]);
    vec y[U], w[U], F[U];
    EACH {
        F[u] = F_OF(u) * hhh;
        y[u] = vec_all(h * o->x0);
        w[u] = vec_fnma(half, FREE_FORCE(y[u], F[u] * c), vec_all(h * h * o->v0));
    }
    SEAL(y);
    for (int64_t n = 0; n < o->steps; n++) {
        c = vec_all(o->whole[n]);
        EACH {
            vec drive = vec_fma(F[u], c, w[u]);
            w[u] = FREE_FORCE(y[u], drive);
            y[u] += w[u];
        }
    }
    SEAL(y);
    c = vec_all(o->whole[o->steps]);
    EACH {
        STORE(x, u, y[u] * vec_all(1 / h));
        STORE(v, u, vec_fma(half, FREE_FORCE(y[u], F[u] * c), w[u]) * vec_all(1 / (h * h)));
    }
}

/* The recursion in positions, y[n+1] = y[n] (y[n]² + 2 - h²) + (h³ F c - y[n-1]): three operations a step, all fused.
 * Differences of neighbouring positions are lost in it, 1/h times the round-off of the others; so it is shown, not
 * compared with. */
BLOCK(free_position)
{
    double h = o->step;
    vec hh = vec_all(h * h), hhh = vec_all(h * h * h), half = vec_all(0.5), two = vec_all(2 - h * h),
        c = vec_all(o->whole[0]);
    vec y[U], z[U], F[U];
    EACH {
        F[u] = F_OF(u) * hhh;
        y[u] = vec_all(h * o->x0);
        z[u] = y[u] - vec_fnma(half, FREE_FORCE(y[u], F[u] * c), vec_all(h * h * o->v0));
    }
    SEAL(y);
    for (int64_t n = 0; n < o->steps; n += 2) {
        vec odd = vec_all(o->whole[n + 1]);
        c = vec_all(o->whole[n]);
        EACH {
            z[u] = vec_fma(y[u], vec_fma(y[u], y[u], two), vec_fms(F[u], c, z[u]));
            y[u] = vec_fma(z[u], vec_fma(z[u], z[u], two), vec_fms(F[u], odd, y[u]));
        }
    }
    SEAL(y);
    c = vec_all(o->whole[o->steps]);
    EACH {
        STORE(x, u, y[u] * vec_all(1 / h));
        STORE(v, u, vec_fma(half, FREE_FORCE(y[u], F[u] * c), y[u] - z[u]) * vec_all(1 / (h * h)));
    }
}

/* Kutta's method as Nyström wrote it: the velocities of the stages are eliminated, and in the same units 24
 * operations are left of 34. The drive at the end of a step is kept for the beginning of the next. */
BLOCK(free_rk4)
{
    double h = o->step;
    vec hh = vec_all(h * h), hhh = vec_all(h * h * h), half = vec_all(0.5), quarter = vec_all(0.25),
        sixth = vec_all(1.0 / 6);
    vec y[U], w[U], F[U], end[U];
    EACH {
        F[u] = F_OF(u) * hhh;
        end[u] = F[u] * vec_all(o->whole[0]);
        y[u] = vec_all(h * o->x0);
        w[u] = vec_all(h * h * o->v0);
    }
    SEAL(y);
    for (int64_t n = 0; n < o->steps; n++) {
        vec c1 = vec_all(o->half[n]), c2 = vec_all(o->whole[n + 1]);
        EACH_GROUP
        {
            vec Y[S], k1[S], k2[S], k3[S], far[S], middle[S];
            EACH_IN_GROUP
            {
                k1[s] = FREE_FORCE(y[u], end[u]);
                Y[s] = vec_fma(half, w[u], y[u]);
                far[s] = y[u] + w[u];
                middle[s] = F[u] * c1;
            }
            EACH_IN_GROUP
            {
                k2[s] = FREE_FORCE(Y[s], middle[s]);
                Y[s] = vec_fma(quarter, k1[s], Y[s]);
            }
            EACH_IN_GROUP
            {
                k3[s] = FREE_FORCE(Y[s], middle[s]);
                end[u] = F[u] * c2;
                Y[s] = vec_fma(half, k2[s], far[s]);
            }
            EACH_IN_GROUP
            {
                vec k4 = FREE_FORCE(Y[s], end[u]), k23 = k2[s] + k3[s], sum = k1[s] + k23;
                y[u] = vec_fma(sixth, sum, far[s]);
                w[u] = vec_fma(sixth, sum + (k23 + k4), w[u]);
            }
        }
    }
    SEAL(y);
    EACH {
        STORE(x, u, y[u] * vec_all(1 / h));
        STORE(v, u, w[u] * vec_all(1 / (h * h)));
    }
}

#undef JOIN_
#undef JOIN
#undef BLOCK
#undef EACH
#undef EACH_GROUP
#undef EACH_IN_GROUP
#undef SEAL
#undef F_OF
#undef STORE
#undef FORCE
#undef FREE_FORCE
#undef U
#undef S
