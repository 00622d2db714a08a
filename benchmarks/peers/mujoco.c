/*
 * MuJoCo's inverse and direct dynamics. `peer_load` reads an MJCF file, in which constraints, contacts, sensors,
 * actuators, springs and dampers are switched off.
 */
#include <mujoco/mujoco.h>

#include <string.h>

#include "peer.h"

PEER extern const int peer_keeps_results;
const int peer_keeps_results = 1;

static mjModel *model;
static mjData *data;

int peer_load(const char *file)
{
    char error[1000] = "";
    model = mj_loadXML(file, NULL, error, sizeof error);
    if (!model) {
        fprintf(stderr, "%s\n", error);
        return 1;
    }
    data = mj_makeData(model);
    return data == NULL;
}

static void set(mjtNum *to, const double *values)
{
    memcpy(to, values, (size_t)model->nv * sizeof *to);
}

static void copy(const mjtNum *result, double *out)
{
    if (out) {
        memcpy(out, result, (size_t)model->nv * sizeof *out);
    }
}

void inverse_dynamics(const double *q, const double *qd, const double *qdd, double *out)
{
    set(data->qpos, q);
    set(data->qvel, qd);
    set(data->qacc, qdd);
    mj_inverse(model, data);
    copy(data->qfrc_inverse, out);
}

void direct_dynamics(const double *q, const double *qd, const double *tau, double *out)
{
    set(data->qpos, q);
    set(data->qvel, qd);
    set(data->qfrc_applied, tau);
    mj_forward(model, data);
    copy(data->qacc, out);
}
