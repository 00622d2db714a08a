/* Rigid chain: Newton-Euler for torques, composite bodies for the inertia matrix, both about the frames' origins. */
#include <math.h>
#include <string.h>

#include "plant.h"

static void turn(double R[3][3], const double *x, double *y)
{
    for (int i = 0; i < 3; ++i) y[i] = R[i][0] * x[0] + R[i][1] * x[1] + R[i][2] * x[2];
}

static void turn_back(double R[3][3], const double *x, double *y)
{
    for (int i = 0; i < 3; ++i) y[i] = R[0][i] * x[0] + R[1][i] * x[1] + R[2][i] * x[2];
}

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void add_cross(const double *a, const double *b, double *c)
{
    double x[3];
    cross(a, b, x);
    for (int i = 0; i < 3; ++i) c[i] += x[i];
}

static void times_inertia(const double *I, const double *x, double *y)
{
    y[0] = I[0] * x[0] + I[1] * x[1] + I[2] * x[2];
    y[1] = I[1] * x[0] + I[3] * x[1] + I[4] * x[2];
    y[2] = I[2] * x[0] + I[4] * x[1] + I[5] * x[2];
}

/* R, o: axes and origin of each frame in the one before. */
void plant_frames(const struct plant *p, const double *q, double R[][3][3], double o[][3])
{
    for (int j = 0; j < p->n; ++j) {
        const double *dh = p->dh[j];
        const double theta = dh[2] + (p->prismatic[j] ? 0.0 : q[j]), r = dh[3] + (p->prismatic[j] ? q[j] : 0.0);
        const double ca = cos(dh[0]), sa = sin(dh[0]), ct = cos(theta), st = sin(theta);
        const double rows[3][3] = {{ct, -st, 0.0}, {ca * st, ca * ct, -sa}, {sa * st, sa * ct, ca}};
        memcpy(R[j], rows, sizeof rows);
        o[j][0] = dh[1];
        o[j][1] = -sa * r;
        o[j][2] = ca * r;
    }
}

/* Torques of the motion and of the weight; qdd may be null: no acceleration. */
void plant_bias(const struct plant *p, double R[][3][3], double o[][3], const double *qd, const double *qdd, double *tau)
{
    double w[JOINTS][3], wd[3] = {0}, a[3], f[JOINTS][3], m[JOINTS][3], w_before[3] = {0}, wd_before[3] = {0}, a_before[3];
    for (int i = 0; i < 3; ++i) a_before[i] = -p->gravity[i];
    for (int j = 0; j < p->n; ++j) {
        double x[3], y[3];
        cross(w_before, o[j], y);
        memcpy(x, a_before, sizeof x);
        add_cross(wd_before, o[j], x);
        add_cross(w_before, y, x);
        turn_back(R[j], x, a);
        turn_back(R[j], w_before, w[j]);
        turn_back(R[j], wd_before, wd);
        const double z[3] = {0.0, 0.0, qd[j]};
        if (p->prismatic[j]) {
            cross(w[j], z, y);
            for (int i = 0; i < 3; ++i) a[i] += 2.0 * y[i];
            a[2] += qdd ? qdd[j] : 0.0;
        } else {
            add_cross(w[j], z, wd);
            wd[2] += qdd ? qdd[j] : 0.0;
            w[j][2] += qd[j];
        }
        const double *b = p->body[j], *moment = b + 1;
        double Iw[3];
        cross(w[j], moment, y);
        for (int i = 0; i < 3; ++i) f[j][i] = b[0] * a[i];
        add_cross(wd, moment, f[j]);
        add_cross(w[j], y, f[j]);
        times_inertia(b + 4, wd, m[j]);
        times_inertia(b + 4, w[j], Iw);
        add_cross(w[j], Iw, m[j]);
        add_cross(moment, a, m[j]);
        memcpy(w_before, w[j], sizeof w_before);
        memcpy(wd_before, wd, sizeof wd_before);
        memcpy(a_before, a, sizeof a_before);
    }
    for (int j = p->n - 1; j >= 0; --j) {
        tau[j] = p->prismatic[j] ? f[j][2] : m[j][2];
        if (j > 0) {
            double x[3], y[3];
            turn(R[j], f[j], x);
            turn(R[j], m[j], y);
            add_cross(o[j], x, y);
            for (int i = 0; i < 3; ++i) {
                f[j - 1][i] += x[i];
                m[j - 1][i] += y[i];
            }
        }
    }
}

/* What is behind a joint, as one body in the frame before: c gets the body b moved by R, o. */
static void add_moved(double *c, const double *b, double R[3][3], const double *o)
{
    static const int at[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
    const double I[3][3] = {{b[4], b[5], b[6]}, {b[5], b[7], b[8]}, {b[6], b[8], b[9]}};
    double h[3], RI[3][3];
    turn(R, b + 1, h);
    const double oh = o[0] * h[0] + o[1] * h[1] + o[2] * h[2], oo = o[0] * o[0] + o[1] * o[1] + o[2] * o[2];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) RI[i][k] = R[i][0] * I[0][k] + R[i][1] * I[1][k] + R[i][2] * I[2][k];
    c[0] += b[0];
    for (int i = 0; i < 3; ++i) c[1 + i] += h[i] + b[0] * o[i];
    for (int e = 0; e < 6; ++e) {
        const int i = at[e][0], k = at[e][1];
        c[4 + e] += RI[i][0] * R[k][0] + RI[i][1] * R[k][1] + RI[i][2] * R[k][2] + (i == k ? 2.0 * oh + b[0] * oo : 0.0)
                    - o[i] * h[k] - h[i] * o[k] - b[0] * o[i] * o[k];
    }
}

void plant_mass(const struct plant *p, double R[][3][3], double o[][3], double M[][JOINTS])
{
    double c[JOINTS][10];
    memcpy(c, p->body, sizeof c);
    for (int j = p->n - 1; j > 0; --j) add_moved(c[j - 1], c[j], R[j], o[j]);
    for (int j = 0; j < p->n; ++j) {
        const double *h = c[j] + 1, *I = c[j] + 4;
        double f[3] = {-h[1], h[0], 0.0}, m[3] = {I[2], I[4], I[5]};
        if (p->prismatic[j]) {
            const double force[3] = {0.0, 0.0, c[j][0]}, moment[3] = {h[1], -h[0], 0.0};
            memcpy(f, force, sizeof f);
            memcpy(m, moment, sizeof m);
        }
        for (int i = j; i >= 0; --i) {
            M[i][j] = M[j][i] = p->prismatic[i] ? f[2] : m[2];
            double x[3], y[3];
            turn(R[i], f, x);
            turn(R[i], m, y);
            add_cross(o[i], x, y);
            memcpy(f, x, sizeof f);
            memcpy(m, y, sizeof m);
        }
    }
}

/* Joint torques of many samples (rows x n each), rotors included. */
void plant_torques(const struct plant *p, int rows, const double *q, const double *qd, const double *qdd, double *tau)
{
    double R[JOINTS][3][3], o[JOINTS][3];
    for (int k = 0; k < rows; ++k) {
        const int at = k * p->n;
        plant_frames(p, q + at, R, o);
        plant_bias(p, R, o, qd + at, qdd + at, tau + at);
        for (int i = 0; i < p->n; ++i)
            for (int j = 0; j < p->n; ++j) tau[at + i] += p->rotor[i][j] * qdd[at + j];
    }
}

/* Inertia matrix (n x n) of the bodies, and the energy of their weight. */
double plant_state(const struct plant *p, const double *q, double *mass)
{
    double R[JOINTS][3][3], o[JOINTS][3], M[JOINTS][JOINTS], g[3], energy = 0.0;
    plant_frames(p, q, R, o);
    plant_mass(p, R, o, M);
    for (int i = 0; i < p->n; ++i)
        for (int j = 0; j < p->n; ++j) mass[i * p->n + j] = M[i][j];
    double total[JOINTS][10];
    memcpy(total, p->body, sizeof total);
    for (int j = p->n - 1; j > 0; --j) add_moved(total[j - 1], total[j], R[j], o[j]);
    double base[10] = {0};
    add_moved(base, total[0], R[0], o[0]);
    memcpy(g, p->gravity, sizeof g);
    for (int i = 0; i < 3; ++i) energy -= g[i] * base[1 + i];
    return energy;
}
