/* The simulated robot: what Python fills in, and what its parts call of each other. SI units throughout.
 *
 * Coordinates are joint coordinates on the joint side: q of the links, th of the motors over their ratios. A rigid joint has
 * th = q. Frames are modified Denavit-Hartenberg frames; bodies are given about the origin of their frame. */
#ifndef PLANT_H
#define PLANT_H

#define JOINTS 8
#define EFFECTS 64
#define VALUES 12
#define STATES 12

struct effect {
    int law, joint, other, unused;
    double weight[JOINTS]; /* speed = weight . speeds; the torque goes back along the same weights */
    double size;
    double value[VALUES];
    double state[STATES];
    double torque; /* mean over the last step */
};

struct plant {
    int n, effects;
    int prismatic[JOINTS], flexible[JOINTS];
    double dh[JOINTS][4];    /* alpha, d, theta, r with the joint at zero */
    double body[JOINTS][10]; /* mass, first moments x y z, inertia xx xy xz yy yz zz */
    double gravity[3];       /* free fall, in frame 0 */
    double rotor[JOINTS][JOINTS];
    double stiffness[JOINTS], damping[JOINTS], gap[JOINTS]; /* of elastic drive trains; gap is half the play */
    double ratio[JOINTS][JOINTS], inverse[JOINTS][JOINTS];  /* motor angle = ratio th, th = inverse motor angle */
    double constant[JOINTS], gain[JOINTS], limit[JOINTS];   /* torque constant, its true factor, largest current */
    double heat_drop[JOINTS], heat_time[JOINTS], heat_current[JOINTS], heat[JOINTS]; /* gain lost to a hot winding */
    double encoder_step[JOINTS], encoder_scale[JOINTS], encoder_offset[JOINTS];
    double inertia[JOINTS], position_gain[JOINTS], speed_gain[JOINTS], integral_gain[JOINTS];
    double lag, speed_filter, start_time;
    struct effect effect[EFFECTS];
};

/* What a law sees: means over one step of h seconds. */
struct scene {
    double t, h;
    const double *q, *qd, *th, *thd, *load, *friction;
    const struct plant *plant;
};

void plant_frames(const struct plant *p, const double *q, double R[][3][3], double o[][3]);
void plant_mass(const struct plant *p, double R[][3][3], double o[][3], double M[][JOINTS]);
void plant_bias(const struct plant *p, double R[][3][3], double o[][3], const double *qd, const double *qdd, double *tau);
int law_is_friction(int law);
int law_is_of_links(int law);
double law_torque(const struct scene *at, struct effect *e);

#endif
