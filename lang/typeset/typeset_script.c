/* Names of a typeset statement, with subscripts, primes and the time of a value; and indices that run. */
#include "lang/typeset/typeset_parts.h"

bool typeset_head(const tree *t, head *h)
{
    *h = (head){0};
    if (t->kind == TREE_COMPONENT) {
        h->component = t->item[1];
        t = t->item[0];
    }
    if (t->kind == TREE_APPLY) {
        h->applied = t;
        t = t->item[0];
    }
    h->name = t;
    return t->kind == TREE_NAME;
}

/* Returns the letter of a component .x .y .z, which is a number in the tree, or NULL. */
static const char *component_letter(const source *s, const tree *number)
{
    static const char *const letters[] = {"x", "y", "z"};
    char c = s->texts[number->at.text].bytes[number->at.from];
    return number->kind == TREE_NUMBER && c >= 'x' && c <= 'z' ? letters[c - 'x'] : NULL;
}

/* Writes the subscripts of x_{max,i,y}: one part is an element, several are a row. */
static void subscripts(typesetter *p, const head *h, uint32_t parts, place at)
{
    place in = parts == 1 ? place_script(at) : place_inside(at) | PLACE_SMALL;
    uint32_t done = 0;
    if (parts > 1) typeset_tag(p, "<mrow>");
    if (typeset_has_tail(h->name->name)) {
        typeset_word(p, TASK_TAIL, h->name->name);
        done++;
    }
    for (uint32_t i = 0; i < h->name->index_count; i++) {
        if (done++) typeset_sign(p, "<mo>,</mo>");
        typeset_then(p, h->name->item[i], in);
    }
    if (h->component) {
        if (done) typeset_sign(p, "<mo>,</mo>");
        const char *letter = component_letter(&p->model->source, h->component);
        if (letter)
            typeset_word(p, TASK_NAME, letter);
        else
            typeset_then(p, h->component, in);
    }
    if (parts > 1) typeset_tag(p, "</mrow>");
}

static void superscripts(typesetter *p, int primes, const tree *power, place at)
{
    bool both = primes && power;
    if (both) typeset_tag(p, "<mrow>");
    if (primes) typeset_tag(p, primes == 1 ? "<mo class=\"prime\">′</mo>" : "<mo class=\"prime\">′′</mo>");
    if (power) typeset_then(p, power, both ? place_inside(at) | PLACE_SMALL : place_script(at));
    if (both) typeset_tag(p, "</mrow>");
}

/* Writes a name with its scripts. Primes and an exponent share the superscript, x′²; a value at a time is raised with
 * its bracket, x(0)². */
void typeset_scripted(typesetter *p, const head *h, const tree *power, place at)
{
    uint32_t parts = (uint32_t)typeset_has_tail(h->name->name) + h->name->index_count + (h->component != NULL);
    const tree *own_power = h->applied ? NULL : power;
    int scripts = 2 * (parts > 0) + (h->name->primes || own_power);
    static const char *const open[] = {"", "<msup>", "<msub>", "<msubsup>"}, *const close[] = {"", "</msup>", "</msub>",
                                                                                               "</msubsup>"};
    if (h->applied && power) typeset_tag(p, "<msup>");
    if (h->applied) typeset_tag(p, "<mrow>");
    typeset_tag(p, open[scripts]);
    typeset_word(p, TASK_NAME, h->name->name);
    if (parts) subscripts(p, h, parts, at);
    if (scripts & 1) superscripts(p, h->name->primes, own_power, at);
    typeset_tag(p, close[scripts]);
    if (h->applied) {
        typeset_tag(p, TYPESET_APPLY);
        typeset_arguments(p, h->applied, at);
        typeset_tag(p, "</mrow>");
    }
    if (h->applied && power) {
        typeset_then(p, power, place_script(at));
        typeset_tag(p, "</msup>");
    }
}

void typeset_component(typesetter *p, const tree *t, place at)
{
    typeset_tag(p, "<msub>");
    typeset_then(p, t->item[0], place_element(at) | TIGHT_ATOM);
    const char *letter = component_letter(&p->model->source, t->item[1]);
    if (letter)
        typeset_word(p, TASK_NAME, letter);
    else
        typeset_then(p, t->item[1], place_script(at));
    typeset_tag(p, "</msub>");
}

void typeset_range(typesetter *p, const loop *l, const char *between, place at)
{
    bool tail = typeset_has_tail(l->name);
    typeset_tag(p, tail ? "<msub>" : "");
    typeset_word(p, TASK_NAME, l->name);
    if (tail) typeset_word(p, TASK_TAIL, l->name);
    typeset_tag(p, tail ? "</msub>" : "");
    typeset_sign(p, "<mo>=</mo>");
    typeset_then(p, l->first, place_inside(at));
    if (!between) return;
    typeset_sign(p, between);
    typeset_then(p, l->last, place_inside(at));
}
