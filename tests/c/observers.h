/* Observers written in C++. */
#ifndef TESTS_C_OBSERVERS_H
#define TESTS_C_OBSERVERS_H

#include <kinemesh.h>

enum { THROW_NOTHING, THROW_EXCEPTION, THROW_NUMBER };

#ifdef __cplusplus
extern "C" {
#endif

/* what: one of these numbers, int32_t. */
int throws(const kinemesh_changes* changes, void* what);

#ifdef __cplusplus
}
#endif

#endif
