/* What PUT does. Included twice: for one number, and for WIDTH numbers side by side. The includer defines NUMBER, their
 * type; NUMBER_OF(x), x as that type; NUMBER_AT(a, k), the element or elements at a[k]; window_number, the function's
 * name.
 */
static inline void window_number(const window_put *how, real *restrict x, real *restrict v, real *restrict a, size_t k,
                                 NUMBER value)
{
    if (!how->pass) {
        NUMBER_AT(a, k) = value;
        return;
    }
    NUMBER at = NUMBER_AT(x, k), speed = NUMBER_AT(v, k);
    if (ROW(how, compensated)) {
        NUMBER start = NUMBER_AT(how->x, k), ev = NUMBER_AT(how->ev, k), ex = NUMBER_AT(how->ex, k);
        NUMBER low = how->opens ? NUMBER_OF(0.0) : NUMBER_AT(how->low, k);
        APART_KICK(how->opens, ev, low, NUMBER_OF(how->b), value);
        if (how->ends) {
            ADVANCE(ex, NUMBER_OF(how->c), ev);
            APART_END_X(start, ex, speed, NUMBER_OF(how->way), NUMBER_OF(how->way_low));
            APART_END_V(speed, ev, low);
            NUMBER_AT(how->x, k) = start;
            NUMBER_AT(v, k) = speed;
        } else {
            NUMBER_AT(how->low, k) = low;
        }
        const clock c = how->ends ? how->next : how->c, way = how->ends ? how->next : how->way;
        if (how->twice || !how->ends)
            APART_DRIFT(at, start, ex, NUMBER_OF(way), NUMBER_OF(how->ends ? 0.0 : how->way_low), speed, NUMBER_OF(c),
                        ev);
        NUMBER_AT(how->ev, k) = ev;
        NUMBER_AT(how->ex, k) = ex;
    } else {
        ADVANCE(speed, NUMBER_OF(how->b), value);
        ADVANCE(at, NUMBER_OF(how->c), speed);
        if (how->twice) ADVANCE(at, NUMBER_OF(how->next), speed);
        NUMBER_AT(v, k) = speed;
    }
    NUMBER_AT(a, k) = at;
}
#undef NUMBER
#undef NUMBER_OF
#undef NUMBER_AT
#undef window_number
