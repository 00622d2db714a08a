/* The closed loop: cascade controller, current lag, drive trains, chain, laws; second order in the step.
 *
 * Positions drift half a step, speeds jump a whole one, positions drift again (Stoermer and Verlet), with laws
 * and centrifugal torques at a speed extrapolated to the middle of the step. */
#include <math.h>
#include <string.h>

#include "plant.h"

#define COORDINATES (2 * JOINTS)

struct mid {
    double a[COORDINATES], friction[JOINTS], load[JOINTS], effect[EFFECTS];
};

struct loop {
    double x[COORDINATES], v[COORDINATES];
    int m, motor[JOINTS]; /* number of coordinates; which one is the motor's */
    double measured[JOINTS], speed[JOINTS], integral[JOINTS];
    double target[JOINTS], asked[JOINTS], current[JOINTS], command[JOINTS]; /* currents: clipped, as if not clipped */
    double heat[JOINTS];
    double keep, keep_half; /* of a current in a step and in half of one */
    struct mid mid;
};

static int solve(int m, double A[][COORDINATES], double *b)
{
    for (int j = 0; j < m; ++j) {
        for (int k = 0; k < j; ++k) A[j][j] -= A[j][k] * A[j][k];
        if (!(A[j][j] > 0.0)) return 1;
        A[j][j] = sqrt(A[j][j]);
        for (int i = j + 1; i < m; ++i) {
            for (int k = 0; k < j; ++k) A[i][j] -= A[i][k] * A[j][k];
            A[i][j] /= A[j][j];
        }
    }
    for (int i = 0; i < m; ++i) {
        for (int k = 0; k < i; ++k) b[i] -= A[i][k] * b[k];
        b[i] /= A[i][i];
    }
    for (int i = m - 1; i >= 0; --i) {
        for (int k = i + 1; k < m; ++k) b[i] -= A[k][i] * b[k];
        b[i] /= A[i][i];
    }
    return 0;
}

static double through_gap(double twist, double gap)
{
    return twist > gap ? twist - gap : (twist < -gap ? twist + gap : 0.0);
}

/* Joint positions as the controller reads them from the motors' encoders. */
static void read_encoders(const struct plant *p, const struct loop *s, double *q)
{
    double angle[JOINTS];
    for (int i = 0; i < p->n; ++i) {
        angle[i] = 0.0;
        for (int j = 0; j < p->n; ++j)
            angle[i] += p->ratio[i][j] * (p->encoder_scale[j] * s->x[s->motor[j]] + p->encoder_offset[j]);
        if (p->encoder_step[i] > 0.0) angle[i] = p->encoder_step[i] * rint(angle[i] / p->encoder_step[i]);
    }
    for (int i = 0; i < p->n; ++i) {
        q[i] = 0.0;
        for (int j = 0; j < p->n; ++j) q[i] += p->inverse[i][j] * angle[j];
    }
}

/* P of the position, PI of the speed with the reference's speed fed forward, in the controller's own units of torque. */
static void control(const struct plant *p, struct loop *s, double period, const double *qr, const double *qdr)
{
    double q[JOINTS], torque[JOINTS], wish[JOINTS];
    const double keep = exp(-period / p->speed_filter);
    read_encoders(p, s, q);
    for (int j = 0; j < p->n; ++j) {
        s->speed[j] = keep * s->speed[j] + (1.0 - keep) * (q[j] - s->measured[j]) / period;
        s->measured[j] = q[j];
        wish[j] = qdr[j] + p->position_gain[j] * (qr[j] - q[j]) - s->speed[j];
        torque[j] = p->inertia[j] * (p->speed_gain[j] * wish[j] + s->integral[j]);
    }
    for (int i = 0; i < p->n; ++i) {
        s->asked[i] = 0.0;
        for (int j = 0; j < p->n; ++j) s->asked[i] += p->inverse[j][i] * torque[j];
        s->asked[i] /= p->constant[i];
        s->target[i] = fmax(-p->limit[i], fmin(p->limit[i], s->asked[i]));
        if (s->target[i] == s->asked[i]) s->integral[i] += period * p->speed_gain[i] * p->integral_gain[i] * wish[i];
    }
}

static void drive_torques(const struct plant *p, struct loop *s, double h, double *tau)
{
    const double keep = s->keep, half = s->keep_half;
    double rotor[JOINTS];
    for (int i = 0; i < p->n; ++i) {
        const double middle = s->target[i] + (s->current[i] - s->target[i]) * half;
        const double square = middle / p->heat_current[i];
        rotor[i] = p->constant[i] * (p->gain[i] - p->heat_drop[i] * s->heat[i]) * middle;
        s->current[i] = s->target[i] + (s->current[i] - s->target[i]) * keep;
        s->command[i] = s->asked[i] + (s->command[i] - s->asked[i]) * keep;
        s->heat[i] += h / p->heat_time[i] * (square * square - s->heat[i]);
    }
    for (int j = 0; j < p->n; ++j) {
        tau[j] = 0.0;
        for (int i = 0; i < p->n; ++i) tau[j] += p->ratio[i][j] * p->encoder_scale[j] * rotor[i];
    }
}

static void law_torques(struct plant *p, struct loop *s, const struct scene *at, double *on_motor, double *on_link)
{
    double friction[JOINTS] = {0};
    for (int second = 0; second < 2; ++second)
        for (int k = 0; k < p->effects; ++k) {
            struct effect *e = &p->effect[k];
            if (law_is_friction(e->law) == second) continue;
            e->torque = law_torque(at, e);
            s->mid.effect[k] = e->torque;
            double *side = law_is_of_links(e->law) ? on_link : on_motor;
            for (int j = 0; j < p->n; ++j) {
                side[j] += e->weight[j] * e->torque;
                if (!second) s->mid.friction[j] = friction[j] += e->weight[j] * e->torque;
            }
        }
}

static int step(struct plant *p, struct loop *s, double t, double h)
{
    const int n = p->n;
    double x[COORDINATES], v[COORDINATES], th[JOINTS], thd[JOINTS], tau[JOINTS], on_motor[JOINTS] = {0}, on_link[JOINTS] = {0};
    double R[JOINTS][3][3], o[JOINTS][3], M[JOINTS][JOINTS], bias[JOINTS], A[COORDINATES][COORDINATES], b[COORDINATES];
    for (int i = 0; i < s->m; ++i) {
        x[i] = s->x[i] + 0.5 * h * s->v[i];
        v[i] = s->v[i] + 0.5 * h * s->mid.a[i];
    }
    for (int j = 0; j < n; ++j) {
        th[j] = x[s->motor[j]];
        thd[j] = v[s->motor[j]];
    }
    plant_frames(p, x, R, o);
    plant_mass(p, R, o, M);
    plant_bias(p, R, o, v, 0, bias);
    drive_torques(p, s, h, tau);
    const struct scene at = {t + 0.5 * h, h, x, v, th, thd, s->mid.load, s->mid.friction, p};
    law_torques(p, s, &at, on_motor, on_link);

    memset(A, 0, sizeof A);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) A[i][j] = M[i][j];
        b[i] = -bias[i] - on_link[i];
    }
    for (int j = n; j < s->m; ++j) b[j] = 0.0;
    for (int j = 0; j < n; ++j) {
        for (int k = 0; k < n; ++k) A[s->motor[j]][s->motor[k]] += p->rotor[j][k];
        b[s->motor[j]] += tau[j] - on_motor[j];
        if (p->flexible[j]) {
            const double twist = through_gap(th[j] - x[j], p->gap[j]);
            const double pull = p->stiffness[j] * twist + (twist != 0.0 ? p->damping[j] * (thd[j] - v[j]) : 0.0);
            b[j] += pull;
            b[s->motor[j]] -= pull;
        }
    }
    if (solve(s->m, A, b)) return 1;
    memcpy(s->mid.a, b, sizeof(double) * (size_t)s->m);
    for (int i = 0; i < s->m; ++i) {
        s->v[i] += h * b[i];
        s->x[i] = x[i] + 0.5 * h * s->v[i];
    }
    for (int i = 0; i < n; ++i) {
        s->mid.load[i] = bias[i] + on_link[i];
        for (int j = 0; j < n; ++j) s->mid.load[i] += M[i][j] * b[j];
        if (!(fabs(s->x[i]) < 1e6)) return 1;
    }
    return 0;
}

static double *put(double *row, int n, const double *a, const double *b)
{
    for (int j = 0; j < n; ++j) row[j] = b ? 0.5 * (a[j] + b[j]) : a[j];
    return row + n;
}

/* Quantities at a logged instant; means over the step before and the step after for what is known at mid-steps.
 * Order: q qd qdd th thd thdd current command heat friction load (n each), effects. */
static void write(const struct plant *p, const struct loop *at, const struct mid *before, const struct mid *after, double *row)
{
    const double *x[4] = {at->x, at->v, before->a, after->a};
    double motor[4][JOINTS];
    for (int k = 0; k < 4; ++k)
        for (int j = 0; j < p->n; ++j) motor[k][j] = x[k][at->motor[j]];
    row = put(row, p->n, at->x, 0);
    row = put(row, p->n, at->v, 0);
    row = put(row, p->n, before->a, after->a);
    row = put(row, p->n, motor[0], 0);
    row = put(row, p->n, motor[1], 0);
    row = put(row, p->n, motor[2], motor[3]);
    row = put(row, p->n, at->current, 0);
    row = put(row, p->n, at->command, 0);
    row = put(row, p->n, at->heat, 0);
    row = put(row, p->n, before->friction, after->friction);
    row = put(row, p->n, before->load, after->load);
    put(row, p->effects, before->effect, after->effect);
}

/* Runs ``ticks`` controller periods of ``per_tick`` steps h along the reference (ticks x n each), and writes a row every
 * ``per_row`` ticks. The robot starts on the reference. Returns the number of rows, -1 where the motion ran away. */
int plant_run(struct plant *p, double h, int per_tick, int ticks, int per_row, const double *qr, const double *qdr, double *rows)
{
    struct loop s, before;
    memset(&s, 0, sizeof s);
    const int n = p->n, width = 11 * n + p->effects;
    s.m = n;
    s.keep = exp(-h / p->lag);
    s.keep_half = exp(-0.5 * h / p->lag);
    for (int j = 0; j < n; ++j) {
        s.motor[j] = p->flexible[j] ? s.m++ : j;
        s.x[j] = s.x[s.motor[j]] = (qr[j] - p->encoder_offset[j]) / p->encoder_scale[j];
        s.v[j] = s.v[s.motor[j]] = s.speed[j] = qdr[j] / p->encoder_scale[j];
        s.heat[j] = p->heat[j];
    }
    double R[JOINTS][3][3], o[JOINTS][3], hold[JOINTS];
    plant_frames(p, s.x, R, o);
    plant_bias(p, R, o, s.v, 0, hold);
    for (int j = 0; j < n; ++j) s.integral[j] = hold[j] / p->inertia[j];
    read_encoders(p, &s, s.measured);
    for (int j = 0; j < n; ++j) s.measured[j] -= qdr[j] * h * per_tick;
    int written = 0;
    for (int tick = 0; tick < ticks; ++tick) {
        control(p, &s, h * per_tick, qr + tick * n, qdr + tick * n);
        for (int k = 0; k < per_tick; ++k) {
            const int logged = k == 0 && tick % per_row == 0;
            if (logged) before = s;
            if (step(p, &s, p->start_time + h * (tick * per_tick + k), h)) return -1;
            if (logged) write(p, &before, tick ? &before.mid : &s.mid, &s.mid, rows + written++ * width);
        }
    }
    return written;
}

/* The laws alone along a given motion (rows x n, h apart, motors and links together): torque of each effect
 * (rows x effects), held at the same instants. */
void plant_replay(struct plant *p, double h, int rows, const double *q, const double *qd, double *torque)
{
    struct loop s;
    memset(&s, 0, sizeof s);
    for (int k = 0; k < rows; ++k) {
        double none[2][JOINTS] = {{0}};
        const double *x = q + k * p->n, *v = qd + k * p->n;
        const struct scene at = {p->start_time + h * k, h, x, v, x, v, s.mid.load, s.mid.friction, p};
        law_torques(p, &s, &at, none[0], none[1]);
        memcpy(torque + k * p->effects, s.mid.effect, sizeof(double) * (size_t)p->effects);
    }
}
