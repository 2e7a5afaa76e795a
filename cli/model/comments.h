/* What the comments of a model say of its numbers, their units for one: "k = 2   # N/m". */
#ifndef CLI_MODEL_COMMENTS_H
#define CLI_MODEL_COMMENTS_H

/* The comment behind the line of the model's text that gives a column its value: of a parameter or a quantity its own,
 * of a state that of its initial value; to be freed. The column as archives name it: "k", "x'", "r.x(0)",
 * "max(energy)", "x[3].error". NULL: there is none, or no memory. */
char *comments_find(const char *model, const char *column);

#endif
