/*
 * What a library of this comparison exports. All arrays are of double, row-major unless its Python module says
 * otherwise; q, qd, qdd have a number per joint [rad, rad/s, rad/s2], torques are on the joint side [N m].
 *
 * A function that a library lacks is absent from it. `out` may be NULL in a library that has `peer_keeps_results`: it
 * then leaves the results in memory of its own, as its users do.
 */
#ifndef PEER_H
#define PEER_H

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PEER __attribute__((visibility("default")))

/* Reads the robot from `file`; 0 means done. */
PEER int peer_load(const char *file);

PEER void inverse_dynamics(const double *q, const double *qd, const double *qdd, double *out);
PEER void inertia_matrix(const double *q, const double *qd, const double *qdd, double *out);
PEER void direct_dynamics(const double *q, const double *qd, const double *tau, double *out);
PEER void regressor(const double *q, const double *qd, const double *qdd, double *out);
PEER void gravity(const double *q, const double *qd, const double *qdd, double *out);

/* Reads at most `room` doubles from a binary file; returns how many there were. */
static inline size_t peer_read(const char *file, double *values, size_t room)
{
    size_t count = 0;
    FILE *stream = fopen(file, "rb");
    if (stream) {
        count = fread(values, sizeof *values, room, stream);
        fclose(stream);
    }
    return count;
}

#ifdef __cplusplus
}
#endif

#endif
