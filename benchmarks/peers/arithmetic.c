/* Vector arithmetic as fast as the machine does it: chains of operations, each of which waits for its own result alone. */
#include <stddef.h>

#if defined(__AVX512F__)
#define BYTES 64
#define CHAINS 10
#elif defined(__AVX__)
#define BYTES 32
#define CHAINS 6
#else
#define BYTES 16
#define CHAINS 6
#endif

typedef double lanes __attribute__((vector_size(BYTES)));

/* A round is as many instructions of each kind. */
const size_t chains = CHAINS;

static inline __attribute__((always_inline)) double rounds_of(size_t rounds, double start, int fused, int added)
{
    const lanes number = start + (lanes){ 0.0 };
    lanes x[CHAINS];
    lanes y[CHAINS];
    for (size_t c = 0; c < CHAINS; ++c) {
        x[c] = y[c] = number * (double)c;
    }
    for (size_t k = 0; k < rounds; ++k) {
#pragma GCC unroll 16
        for (size_t c = 0; c < CHAINS; ++c) {
            if (fused) {
                x[c] = x[c] * number + number;
            }
            if (added) {
                y[c] = y[c] + number;
            }
        }
    }
    double sum = 0.0;
    for (size_t c = 0; c < CHAINS; ++c) {
        sum += x[c][0] + y[c][0];
    }
    return sum;
}

/* Fused products and sums, sums alone, and both kinds, on every thread; what they return is of no use. */
double products(size_t rounds, double start)
{
    double sum = 0.0;
#pragma omp parallel reduction(+ : sum)
    sum += rounds_of(rounds, start, 1, 0);
    return sum;
}

double sums(size_t rounds, double start)
{
    double sum = 0.0;
#pragma omp parallel reduction(+ : sum)
    sum += rounds_of(rounds, start, 0, 1);
    return sum;
}

double both(size_t rounds, double start)
{
    double sum = 0.0;
#pragma omp parallel reduction(+ : sum)
    sum += rounds_of(rounds, start, 1, 1);
    return sum;
}
