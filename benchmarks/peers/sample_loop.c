/* A function of peer.h for one state, called for each sample. */
#include <stddef.h>

typedef void function(const double *q, const double *qd, const double *qdd, double *out);

/* q, qd, qdd hold nv numbers a sample, out size numbers a sample; where out is NULL the function is given NULL. */
void sample_loop(
    function *call, size_t n, size_t nv, const double *q, const double *qd, const double *qdd, double *out, size_t size)
{
    for (size_t k = 0; k < n; ++k) {
        call(q + k * nv, qd + k * nv, qdd + k * nv, out ? out + k * size : NULL);
    }
}
