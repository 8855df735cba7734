/* joystick_equation.h - the joystick's equation of motion, cut at the kinks of its contact force.
 *
 * The equation numbers are those of Rogers, Garland and Oliver, J. Sound Vib. 274 (2004) 73-89. The contact travel
 * grows with |theta|, so every kink is one fixed angle, and between two neighboring kinks the force is one straight
 * line over the travel. Everything is in one header so that the compiler can expand the equation in place. */
#ifndef JOYSTICK_EQUATION_H
#define JOYSTICK_EQUATION_H

#include <math.h>
#include <stdbool.h>

enum { KINKS = 4, BRANCHES = 2 * (KINKS + 1) };

/* Table 1: the force has the slope k[i] (N/m) from the travel x[i] (m) on. */
typedef struct {
    double x[KINKS], k[KINKS];
} Actuator;

/* Table 2 (SI units), and both damping laws. */
typedef struct {
    double J, m, h, g, a, b;
    Actuator forward, backward;
    bool power_law;
    double C;                                                  /* the constant law */
    double alpha, A_pos, n_pos, A_neg, n_neg, B, m_exponent;   /* the power law, eq. (11) */
    double eps_theta, eps_omega;                               /* its rounding off near zero */
} Joystick;

static const Joystick paper_joystick = {
    .J = 0.01135,
    .m = 0.87,
    .h = 0.082,
    .g = 9.80665,
    .a = 0.02398,
    .b = 0.0050,
    .forward = {{0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3}, {430e3, 2625.0, 1028e3, 5600.0}},
    .backward = {{0.075e-3, 0.1595e-3, 3.054e-3, 3.063e-3}, {659e3, 1191.0, 1112e3, 4090.0}},
    .power_law = false,
    .C = 0.045,
    .alpha = 0.9,
    .A_pos = 0.086,
    .n_pos = 0.084,
    .A_neg = 0.032,
    .n_neg = -0.23,
    .B = 0.051,
    .m_exponent = -0.26,
    .eps_theta = 1e-4,
    .eps_omega = 1e-3,
};

/* The equation of motion between two kinks; it is smooth beyond them too. */
typedef struct {
    double lower, upper;          /* its ends (rad) */
    double signed_a;              /* a*sign(theta) */
    double offset, stiffness;     /* f_x = offset + stiffness*x */
    double A_weighted, half_n;    /* alpha*A and n/2 of eq. (11) on this side */
    double step;                  /* the last suitable step size (s), 0 before the first visit */
} Branch;

typedef struct {
    double b, weight_moment, inverse_J;
    bool power_law;
    double C, B_weighted, half_m, eps_theta_squared, eps_omega_squared;
    Branch branch[BRANCHES]; /* in the order of rising theta */
    unsigned long evaluations;
} Equation;

/* The angle at which the contact travel is x: eq. (3), which is quadratic in tan(theta/2). */
static inline double angle_of_travel(const Joystick *joystick, double x)
{
    const double a = joystick->a, b = joystick->b;
    return 2.0 * atan(x / (a + sqrt(a * a - x * (2.0 * b - x))));
}

/* The branches of one side, from the middle outwards. */
static inline void set_side(Equation *equation, const Joystick *joystick, bool forward)
{
    const Actuator *actuator = forward ? &joystick->forward : &joystick->backward;
    double inner = 0.0, offset = 0.0, stiffness = 0.0;
    for (int i = 0; i <= KINKS; ++i) {
        const double outer = i < KINKS ? angle_of_travel(joystick, actuator->x[i]) : INFINITY;
        equation->branch[forward ? BRANCHES / 2 + i : BRANCHES / 2 - 1 - i] = (Branch){
            .lower = forward ? inner : -outer,
            .upper = forward ? outer : -inner,
            .signed_a = forward ? joystick->a : -joystick->a,
            .offset = offset,
            .stiffness = stiffness,
            .A_weighted = joystick->alpha * (forward ? joystick->A_pos : joystick->A_neg),
            .half_n = 0.5 * (forward ? joystick->n_pos : joystick->n_neg),
        };
        if (i < KINKS) {
            offset += (stiffness - actuator->k[i]) * actuator->x[i];
            stiffness = actuator->k[i];
        }
        inner = outer;
    }
}

static inline void equation_of(const Joystick *joystick, Equation *equation)
{
    *equation = (Equation){
        .b = joystick->b,
        .weight_moment = joystick->m * joystick->g * joystick->h,
        .inverse_J = 1.0 / joystick->J,
        .power_law = joystick->power_law,
        .C = joystick->C,
        .B_weighted = (1.0 - joystick->alpha) * joystick->B,
        .half_m = 0.5 * joystick->m_exponent,
        .eps_theta_squared = joystick->eps_theta * joystick->eps_theta,
        .eps_omega_squared = joystick->eps_omega * joystick->eps_omega,
    };
    set_side(equation, joystick, true);
    set_side(equation, joystick, false);
}

static inline double damping(const Equation *equation, const Branch *branch, double theta, double omega)
{
    if (!equation->power_law)
        return equation->C;
    return branch->A_weighted * pow(theta * theta + equation->eps_theta_squared, branch->half_n) +
           equation->B_weighted * pow(omega * omega + equation->eps_omega_squared, equation->half_m);
}

/* Eq. (1) with the travel of eq. (3) and the moment of eq. (5), all from t = tan(theta/2):
 * tan(theta) = 2*t/(1 - t^2), sin(theta) = 2*t/(1 + t^2), x = tan(theta)*(a*sign(theta) - b*t). */
static inline double acceleration(Equation *equation, const Branch *branch, double theta, double omega)
{
    const double t = tan(0.5 * theta), square = t * t;
    const double scale = 2.0 * t / ((1.0 - square) * (1.0 + square));
    const double tangent = scale * (1.0 + square), sine = scale * (1.0 - square);
    const double x = tangent * (branch->signed_a - equation->b * t);
    const double force = branch->offset + branch->stiffness * x;
    const double contact = force * (branch->signed_a + (x - equation->b) * tangent);
    const double friction = damping(equation, branch, theta, omega) * omega;
    ++equation->evaluations;
    return (equation->weight_moment * sine - contact - friction) * equation->inverse_J;
}

#endif
