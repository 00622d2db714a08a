/* Writing memory as fast as the machine does: what a result of the same size cannot be faster than. */
#include <stddef.h>

typedef double line __attribute__((vector_size(64)));

/* size bytes from to on, both multiples of 64; past the caches if past_caches. */
void stream_write(double *to, size_t size, double value, int past_caches)
{
    const line values = value - (line){ 0.0 };
    const size_t lines = size / sizeof(line);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < lines; ++i) {
#if defined(__AVX512F__) && !defined(__clang__)
        if (past_caches) {
            __builtin_ia32_movntpd512(&to[8 * i], values);
            continue;
        }
#elif defined(__clang__)
        if (past_caches) {
            __builtin_nontemporal_store(values, (line *)&to[8 * i]);
            continue;
        }
#elif defined(__SSE2__)
        typedef double half __attribute__((vector_size(16)));
        const half two = { value, value };
        if (past_caches) {
            for (int k = 0; k < 8; k += 2) {
                __builtin_ia32_movntpd(&to[8 * i + k], two);
            }
            continue;
        }
#endif
        *(line *)&to[8 * i] = values;
    }
}
