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
        NUMBER speed_error = NUMBER_AT(how->ev, k), error = NUMBER_AT(how->ex, k);
        ADVANCE_COMPENSATED(speed, speed_error, NUMBER_OF(how->b), value);
        ADVANCE_COMPENSATED(at, error, NUMBER_OF(how->c), speed);
        if (how->twice) ADVANCE_COMPENSATED(at, error, NUMBER_OF(how->next), speed);
        NUMBER_AT(how->ev, k) = speed_error;
        NUMBER_AT(how->ex, k) = error;
    } else {
        ADVANCE(speed, NUMBER_OF(how->b), value);
        ADVANCE(at, NUMBER_OF(how->c), speed);
        if (how->twice) ADVANCE(at, NUMBER_OF(how->next), speed);
    }
    NUMBER_AT(v, k) = speed;
    NUMBER_AT(a, k) = at;
}
#undef NUMBER
#undef NUMBER_OF
#undef NUMBER_AT
#undef window_number
