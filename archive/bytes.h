/* Bytes at places of a file, transferred completely, or false is returned and errno set. */
#ifndef ARCHIVE_BYTES_H
#define ARCHIVE_BYTES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Read or write `count` bytes at a place. False with errno 0: the file ends before. */
bool bytes_get(int descriptor, void *, size_t count, uint64_t place);
bool bytes_put(int descriptor, const void *, size_t count, uint64_t place);

#endif
