/* The lexer turns characters into tokens: maximal names, exact numbers, primes and line ends. */
#ifndef LANG_TEXT_LEX_H
#define LANG_TEXT_LEX_H

#include "lang/text/source.h"

typedef enum token_kind {
    TOKEN_END,
    TOKEN_NEWLINE, /* `character` is ';' for a semicolon, after which a statement does not go on */
    TOKEN_NUMBER,
    TOKEN_NAME,
    TOKEN_PRIMES,
    TOKEN_DOTS,
    TOKEN_LE,
    TOKEN_GE,
    TOKEN_EQ,
    TOKEN_NE,
    TOKEN_CHARACTER /* `character` is one of + - * / ^ ( ) [ ] | , . = < > : */
} token_kind;

typedef struct token {
    token_kind kind;
    char character;
    bool blank; /* blanks (or a line end) stand before it */
    int primes; /* PRIMES: 1, 2, 3 … */
    double number;
    span at;
} token;

typedef struct lexer {
    source *source;
    uint32_t text, at;
    int depth; /* how many ( and [ are open: line ends inside them do not count */
    uint32_t opened[SOURCE_NESTING_MAX];
    char closer[SOURCE_NESTING_MAX];
} lexer;

void lex_start(lexer *, source *, uint32_t text);
token lex_next(lexer *);

#endif
