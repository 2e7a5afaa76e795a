/* How other languages write what a text may mean: hints after a complaint, by the text around a place. */
#ifndef LANG_TEXT_FOREIGN_H
#define LANG_TEXT_FOREIGN_H

#include "lang/text/source.h"

/* Hints at what an undefined name may be: a unit, a product of vectors, a part of a derivative, Sin[…]. False: nothing
 * around it says that. */
bool foreign_name(source *, const span *name);
/* Hints at what a line may be that begins with an unknown word: def f(x): …, let k = 2, der(x) = v, plot x. False: the
 * word is none of these. */
bool foreign_line(source *, const span *word);
/* Hints how a choice is written, from the `if` of if … then … else …. */
void foreign_choice(source *, const span *word);
/* foreign_signs.c. Hint at a decimal comma in a part of the text, which is false where there is none; at raised signs
 * from here on, as in x² and d²x/dt²; and at a command of LaTeX. */
bool foreign_decimal(source *, const span *in);
void foreign_raised(source *, const span *);
void foreign_latex(source *, const span *);
/* Returns the factor that ends, or begins, beside a place, across blanks; it is empty where there is none. */
span foreign_before(const source *, const span *);
span foreign_after(const source *, const span *);

#endif
