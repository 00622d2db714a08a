/* What several laws are made of. Included by the file that holds the laws. */
#include <math.h>

/* A bristle (LuGre without micro-damping): d z/dt = v/d - |v| z/(d g), so that z -> g sign(v) after a way of d.
 * Solved exactly for a constant v; returns the mean of z over the step. */
static double bristle(double *z, double v, double d, double g, double h)
{
    const double before = *z, end = v > 0.0 ? g : (v < 0.0 ? -g : before), way = fabs(v) * h / (d * (g > 1e-9 ? g : 1e-9));
    *z = way > 40.0 ? end : end + (before - end) * exp(-way);
    return 0.5 * (before + *z);
}

/* A slow wandering about 1 with rms share, of three periods without a common multiple. */
static double wander(double t, double share, double phase)
{
    return 1.0 + share * 0.8165 * (sin(0.41 * t + phase) + sin(0.93 * t + 2.3 * phase) + sin(0.137 * t + 5.1 * phase));
}

/* Share of a cold start that is left after t seconds: oil and housing. */
static double coldness(double t, double fast, double slow, double share)
{
    return share * exp(-t / fast) + (1.0 - share) * exp(-t / slow);
}

/* Crank between a fixed pivot at distance d21 and a moving one at d22, phi between the arms: length of the line between them,
 * and the torque that a pull of force along it asks of the joint. */
static double crank_length(double q, double d21, double d22, double phi)
{
    return hypot(d21 + d22 * cos(phi + q), d22 * sin(phi + q));
}

static double crank_torque(double q, double d21, double d22, double phi, double force)
{
    const double x = d22 * cos(phi + q), y = d22 * sin(phi + q), line = hypot(d21 + x, y);
    return force * (x * y - y * (d21 + x)) / line;
}
