/* joystick.c - the joystick with constant damping, written by hand from its equations: contact travel
 * x = a*|tan(theta)| + b*(1 - 1/cos(theta)), and per side two restrained preloaded springs side by side. */
#include "model.h"
#include "parts.h"
#include "token.h"

#include <math.h>
#include <stdio.h>

enum { THETA, OMEGA, ALPHA, X, F_X, M_S, E, N_Y };
enum { J, M, H, G, A, B, C, FORWARD_RETURN, FORWARD_BALANCE = FORWARD_RETURN + 4, BACKWARD_RETURN = FORWARD_BALANCE + 4,
       BACKWARD_BALANCE = BACKWARD_RETURN + 4, T = BACKWARD_BALANCE + 4, FORWARD, CONTACT, RELEASED = CONTACT + 4,
       N_P = RELEASED + 4 };
enum { K_S, K_H, F_0, X_0 }; /* within a spring */

static const double y_start[N_Y] = {[THETA] = -0.3490658503988659};
static const double p_start[N_P] = {0.01135,  0.87,     0.082,   9.80665, 0.02398,   0.005,     0.045,
                                    2625.0,   427375.0, 52.7808125, 0.075e-3, 2975.0, 1022400.0, 11.2464,  2.932e-3,
                                    1191.0,   657809.0, 55.5848605, 0.075e-3, 2899.0, 1107910.0, 9.97119,  3.054e-3};
static const double state_nominal[] = {1.0, 1.0};

static const Variable variables[] = {
    STATE("theta", THETA),
    STATE("omega", OMEGA),
    OUTPUT("alpha", ALPHA),
    OUTPUT("x", X),
    OUTPUT("f_x", F_X),
    OUTPUT("M_s", M_S),
    OUTPUT("E", E),
    INPUT("T", T, ANY),
    PARAMETER("J", J, 1e-9, INFINITY),
    PARAMETER("damping.C", C, 0.0, INFINITY),
};

/* Relation n > 0 belongs to spring (n - 1)/2 of forward return, forward balance, backward return, backward
 * balance. */
static const Relation relations[] = {
    {0, FORWARD, false},     {1, CONTACT, false},      {2, RELEASED, false},
    {3, CONTACT + 1, false}, {4, RELEASED + 1, false}, {5, CONTACT + 2, false},
    {6, RELEASED + 2, false}, {7, CONTACT + 3, false}, {8, RELEASED + 3, false},
};

static const char *const root_texts[] = {"-theta",  "x - x_0", "x - x_1", "x - x_2", "x - x_3",
                                         "x - x_4", "x - x_5", "x - x_6", "x - x_7"};

const Model model = {
    TABLES("Test.Joystick"),
    ROOTS_AND_RELATIONS,
};

static double spring_force(const double *p, int number, double x)
{
    const double *spring = p + FORWARD_RETURN + 4 * number;
    const double compression = x - spring[X_0];
    if (p[CONTACT + number] == 0.0)
        return 0.0;
    return p[RELEASED + number] != 0.0 ? spring[F_0] + spring[K_S] * compression
                                       : (spring[K_H] + spring[K_S]) * compression;
}

typedef struct {
    double x, force, moment, alpha;
} Motion;

static Motion motion(const double *y, const double *p)
{
    const double tangent = tan(y[THETA]), secant = 1.0 / cos(y[THETA]);
    const double sign = p[FORWARD] != 0.0 ? 1.0 : -1.0;
    const double x = p[A] * sign * tangent + p[B] * (1.0 - secant);
    const int side = p[FORWARD] != 0.0 ? 0 : 2;
    const double force = spring_force(p, side, x) + spring_force(p, side + 1, x);
    const double moment = (p[A] * sign + (x - p[B]) * tangent) * force;
    const double gravity = p[M] * p[G] * p[H] * sin(y[THETA]);
    return (Motion){x, force, moment, (p[T] + gravity - moment - p[C] * y[OMEGA]) / p[J]};
}

bool model_derivatives(double time, double *y, const double *p, double *der, double *root)
{
    der[THETA] = y[OMEGA];
    der[OMEGA] = motion(y, p).alpha;
    return root == NULL || model_roots(time, y, p, root);
}

static double spring_energy(const double *p, int number, double x)
{
    const double *spring = p + FORWARD_RETURN + 4 * number;
    const double compression = x - spring[X_0], kink = spring[F_0] / spring[K_H];
    if (compression <= 0.0)
        return 0.0;
    const double first = fmin(compression, kink), second = fmax(compression - kink, 0.0);
    return 0.5 * (spring[K_H] + spring[K_S]) * first * first +
           (spring[F_0] + spring[K_S] * (kink + 0.5 * second)) * second;
}

bool model_algebraics(double time, double *y, const double *p)
{
    (void)time;
    const Motion now = motion(y, p);
    const int side = p[FORWARD] != 0.0 ? 0 : 2;
    y[ALPHA] = now.alpha;
    y[X] = now.x;
    y[F_X] = now.force;
    y[M_S] = now.moment;
    y[E] = 0.5 * p[J] * y[OMEGA] * y[OMEGA] + spring_energy(p, side, now.x) + spring_energy(p, side + 1, now.x) +
           p[M] * p[G] * p[H] * (cos(y[THETA]) - 1.0);
    return true;
}

bool model_roots(double time, double *y, const double *p, double *root)
{
    (void)time;
    const double tangent = tan(y[THETA]), lift = p[B] * (1.0 - 1.0 / cos(y[THETA]));
    root[0] = 0.0 - y[THETA];
    for (int i = 0; i < 4; ++i) {
        const double *spring = p + FORWARD_RETURN + 4 * i;
        const double compression = (i < 2 ? p[A] * tangent : -p[A] * tangent) + lift - spring[X_0];
        root[1 + 2 * i] = 0.0 - compression;
        root[2 + 2 * i] = spring[F_0] / spring[K_H] - compression;
    }
    return true;
}

NO_TIME_RELATIONS
NO_DEPENDENT_PARAMETERS
NO_INITIAL_EQUATIONS
NO_DISCRETE_EQUATIONS
NO_ACTIONS
NO_TANGENTS
