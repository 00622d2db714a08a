/*
 * Times the functions of many libraries in one process, in turn, so that whatever slows the machine slows them all.
 *
 *     harness STATES DOF ROUNDS OUTPUTS PLAN
 *
 * STATES holds q, qd, qdd, tau of each state as doubles. PLAN has a line for each function to time: its name, the size
 * of its output, the library, the library's data, separated by tabs. The outputs at all states go to OUTPUTS, function
 * after function. Prints a line for each: the lower quartile, the median and the upper quartile over ROUNDS of the time
 * of a call, in ns; nothing if ROUNDS is 0.
 */
#define _POSIX_C_SOURCE 200809L

#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "peer.h"

enum { SIGNALS = 4, MOST_STATES = 4096, MOST_JOINTS = 64, MOST_ENTRIES = 512, WORD = 2048 };

typedef void function(const double *, const double *, const double *, double *);

typedef struct {
    char name[WORD], library[WORD], data[WORD];
    size_t size;
    function *call;
    int third; /* the signal behind q and qd: 2 for qdd, 3 for tau */
    int keeps; /* whether it is timed without copying its results */
    double *out;
    double *times;
} entry;

static double states[MOST_STATES * SIGNALS * MOST_JOINTS];
static entry entries[MOST_ENTRIES];

static void fail(const char *what, const char *where)
{
    fprintf(stderr, "harness: %s: %s\n", what, where);
    exit(1);
}

static void *symbol(const entry *one, const char *name)
{
    void *library = dlopen(one->library, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        fail("cannot be loaded", dlerror());
    }
    return dlsym(library, name);
}

static void load(entry *one)
{
    void *address = symbol(one, "peer_load");
    int (*load_data)(const char *);
    memcpy(&load_data, &address, sizeof address);
    if (!address || load_data(one->data) != 0) {
        fail("does not take its data", one->library);
    }
}

static void find(entry *one, size_t states_count)
{
    void *address = symbol(one, one->name);
    if (!address) {
        fail("has no such function", one->name);
    }
    memcpy(&one->call, &address, sizeof address);
    one->keeps = symbol(one, "peer_keeps_results") != NULL;
    one->third = strcmp(one->name, "direct_dynamics") == 0 ? 3 : 2;
    one->out = calloc(states_count * one->size, sizeof(double));
}

static void pass(const entry *one, size_t count, size_t dof, int keeps)
{
    const double *at = states;
    for (size_t k = 0; k < count; ++k, at += SIGNALS * dof) {
        one->call(at, at + dof, at + (size_t)one->third * dof, keeps ? NULL : one->out + k * one->size);
    }
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int count, char **words)
{
    if (count != 6) {
        fail("expected", "harness STATES DOF ROUNDS OUTPUTS PLAN");
    }
    const size_t dof = strtoul(words[2], NULL, 10), rounds = strtoul(words[3], NULL, 10);
    const size_t many = peer_read(words[1], states, sizeof states / sizeof *states) / (SIGNALS * dof);
    FILE *plan = fopen(words[5], "r"), *outputs = fopen(words[4], "wb");
    if (!plan || !outputs || many == 0) {
        fail("cannot be opened", words[5]);
    }
    size_t number = 0;
    for (entry *one = entries; number < MOST_ENTRIES; ++one, ++number) {
        const char *format = "%2047[^\t]\t%zu\t%2047[^\t]\t%2047[^\n]\n";
        if (fscanf(plan, format, one->name, &one->size, one->library, one->data) != 4) {
            break;
        }
        if (number == 0 || strcmp(one->library, one[-1].library) != 0) {
            load(one);
        }
        find(one, many);
        one->times = calloc(rounds + 1, sizeof(double));
    }
    for (size_t k = 0; k < number; ++k) {
        pass(&entries[k], many, dof, 0);
        fwrite(entries[k].out, sizeof(double), many * entries[k].size, outputs);
    }
    for (size_t round = 0; round < rounds; ++round) {
        for (size_t turn = 0; turn < number; ++turn) {
            entry *one = &entries[(turn + round) % number];
            pass(one, many, dof, one->keeps); /* brings code and data into the caches */
            const double start = now();
            pass(one, many, dof, one->keeps);
            one->times[round] = (now() - start) / (double)many;
        }
    }
    for (size_t k = 0; rounds > 0 && k < number; ++k) {
        qsort(entries[k].times, rounds, sizeof(double), compare);
        const double *sorted = entries[k].times;
        printf("%.3f %.3f %.3f\n", sorted[rounds / 4], sorted[rounds / 2], sorted[rounds * 3 / 4]);
    }
    return 0;
}
