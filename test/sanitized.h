/* SANITIZED is defined where AddressSanitizer watches, which makes a program several times slower. */
#ifndef TEST_SANITIZED_H
#define TEST_SANITIZED_H

#ifdef __SANITIZE_ADDRESS__
#define SANITIZED
#elif defined __has_feature
#if __has_feature(address_sanitizer)
#define SANITIZED
#endif
#endif

#endif
