/* Assigns registers by linear scan: each virtual register gets the first number that is free while it lives.
 *
 * Invariant: two registers of a kind that live at one instruction have different numbers, except that a result may take
 * the place of an operand that is read for the last time: kernels go lane by lane, and scalars are read before they are
 * written.
 */
#include "lang/tape/tape_code.h"

bool tape_registers_assign(const motus_allocator *hooks, virtual_register *v, uint32_t count, uint32_t instructions,
                           uint32_t counts[REGISTER_KINDS])
{
    /* ending[k]: the registers whose last reader is instruction k; idle[kind]: the free numbers, last freed first,
     * because that one is still in the cache */
    uint32_t *ending = take(hooks, (size_t)instructions + 2, sizeof *ending);
    uint32_t *idle = take(hooks, count, sizeof *idle);
    uint32_t idle_count[REGISTER_KINDS] = {0}, begin[REGISTER_KINDS + 1] = {0};
    bool ok = ending && idle;
    for (uint32_t i = 0; i < count; i++) begin[v[i].kind + 1]++;
    for (int kind = 0; kind < REGISTER_KINDS; kind++) {
        begin[kind + 1] += begin[kind];
        counts[kind] = 0;
    }
    for (uint32_t k = 0; ok && k < instructions + 2; k++) ending[k] = NONE;
    uint32_t released = 0;
    for (uint32_t i = 0; ok && i < count; i++) {
        for (; released <= v[i].first; released++)
            for (uint32_t j = ending[released]; j != NONE; j = v[j].given.next)
                idle[begin[v[j].kind] + idle_count[v[j].kind]++] = v[j].given.number;
        uint32_t kind = v[i].kind;
        v[i].given.number = idle_count[kind] ? idle[begin[kind] + --idle_count[kind]] : counts[kind]++;
        if (v[i].last <= v[i].first) v[i].last = v[i].first + 1; /* it is written, but never read */
        if (v[i].last <= instructions) {
            v[i].given.next = ending[v[i].last];
            ending[v[i].last] = i;
        }
    }
    give(hooks, idle);
    give(hooks, ending);
    return ok;
}
