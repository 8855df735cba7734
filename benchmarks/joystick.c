/* joystick.c - the joystick's free oscillation, programmed by hand: the yardstick for the speed of the FMU.
 *
 * The Runge-Kutta method of order 5(4) of Dormand and Prince (J. Comp. Appl. Math. 6, 1980) with the dense output of
 * order 4 of Hairer, Norsett and Wanner (Solving Ordinary Differential Equations I, section II.6). A step uses the
 * branch in which it starts; if its dense output reaches the end of the branch, it is truncated there and the next step
 * continues in the next branch. Written for this equation only: two states, no torque. */
#include "joystick_equation.h"
#include "measure.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 901, MAX_NEWTON = 60 };

static const double sample_interval = 1.5 / (SAMPLES - 1);
static const double first_step = 1e-4, smallest_step = 1e-14;
/* An error of 20 rad/s in omega weighs as much as one of 1 rad in theta: their ratio in a swing. */
static const double omega_weight = 1.0 / 20.0;

/* Since theta' = omega, the stages of omega are the slopes of theta. */
typedef struct {
    double omega[7], alpha[7];
    double theta_end, omega_end;
    double theta_dense[5], omega_dense[5];
} Step;

#define SUM_3(k) (3.0 / 40 * k[0] + 9.0 / 40 * k[1])
#define SUM_4(k) (44.0 / 45 * k[0] - 56.0 / 15 * k[1] + 32.0 / 9 * k[2])
#define SUM_5(k) (19372.0 / 6561 * k[0] - 25360.0 / 2187 * k[1] + 64448.0 / 6561 * k[2] - 212.0 / 729 * k[3])
#define SUM_6(k) \
    (9017.0 / 3168 * k[0] - 355.0 / 33 * k[1] + 46732.0 / 5247 * k[2] + 49.0 / 176 * k[3] - 5103.0 / 18656 * k[4])
#define SUM_7(k) \
    (35.0 / 384 * k[0] + 500.0 / 1113 * k[2] + 125.0 / 192 * k[3] - 2187.0 / 6784 * k[4] + 11.0 / 84 * k[5])

/* All stages of a step of size h; alpha[0] is known. */
static void take_stages(Equation *equation, const Branch *branch, double theta, double omega, double h, Step *step)
{
    double *w = step->omega, *a = step->alpha;
    w[0] = omega;
    w[1] = omega + h * (1.0 / 5) * a[0];
    a[1] = acceleration(equation, branch, theta + h * (1.0 / 5) * w[0], w[1]);
    w[2] = omega + h * SUM_3(a);
    a[2] = acceleration(equation, branch, theta + h * SUM_3(w), w[2]);
    w[3] = omega + h * SUM_4(a);
    a[3] = acceleration(equation, branch, theta + h * SUM_4(w), w[3]);
    w[4] = omega + h * SUM_5(a);
    a[4] = acceleration(equation, branch, theta + h * SUM_5(w), w[4]);
    w[5] = omega + h * SUM_6(a);
    a[5] = acceleration(equation, branch, theta + h * SUM_6(w), w[5]);
    w[6] = step->omega_end = omega + h * SUM_7(a);
    step->theta_end = theta + h * SUM_7(w);
    a[6] = acceleration(equation, branch, step->theta_end, w[6]);
}

/* The estimated error of a step of size 1. */
static double error_of(const double slope[7])
{
    return 71.0 / 57600 * slope[0] - 71.0 / 16695 * slope[2] + 71.0 / 1920 * slope[3] - 17253.0 / 339200 * slope[4] +
           22.0 / 525 * slope[5] - 1.0 / 40 * slope[6];
}

static void make_dense(double start, double end, const double slope[7], double h, double c[5])
{
    c[0] = start;
    c[1] = end - start;
    c[2] = h * slope[0] - c[1];
    c[3] = c[1] - h * slope[6] - c[2];
    c[4] = h * (-12715105075.0 / 11282082432.0 * slope[0] + 87487479700.0 / 32700410799.0 * slope[2] -
                10690763975.0 / 1880347072.0 * slope[3] + 701980252875.0 / 199316789632.0 * slope[4] -
                1453857185.0 / 822651844.0 * slope[5] + 69997945.0 / 29380423.0 * slope[6]);
}

/* The dense output at the fraction s of the step. */
static double dense_at(const double c[5], double s)
{
    const double r = 1.0 - s;
    return c[0] + s * (c[1] + r * (c[2] + s * (c[3] + r * c[4])));
}

static double dense_slope_at(const double c[5], double s)
{
    const double r = 1.0 - s;
    const double inner = c[3] + r * c[4], middle = c[2] + s * inner, outer = c[1] + r * middle;
    return outer + s * (r * (inner - s * c[4]) - middle);
}

/* Finds where between low and high the dense output, monotone there, equals `target`, by safeguarded Newton's
 * method. */
static double dense_reaches(const double c[5], double target, double low, double high)
{
    const double before = dense_at(c, low) - target, after = dense_at(c, high) - target;
    double s = before == after ? low : low + (high - low) * before / (before - after);
    for (int i = 0; i < MAX_NEWTON; ++i) {
        const double value = dense_at(c, s) - target;
        if ((value > 0.0) == (after > 0.0))
            high = s;
        else
            low = s;
        const double newton = s - value / dense_slope_at(c, s);
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (fabs(newton - s) <= 1e-15 || fabs(next - s) <= 1e-15)
            return s;
        s = next;
    }
    return s;
}

/* Returns the fraction of the step at which the motion reaches an end of its branch (*boundary), or 2 if it does not.
 * The error control keeps a step far shorter than half an oscillation, so omega changes sign at most once, and theta is
 * monotone before and after. */
static double find_exit(const Branch *branch, const Step *step, double *boundary)
{
    const double *theta = step->theta_dense;
    const bool rises = step->omega_end > 0.0;
    double turn = 0.0;
    if (step->omega[0] * step->omega_end < 0.0) {
        turn = dense_reaches(step->omega_dense, 0.0, 0.0, 1.0);
        *boundary = rises ? branch->lower : branch->upper;
        const double beyond = dense_at(theta, turn) - *boundary;
        if (rises ? beyond < 0.0 : beyond > 0.0)
            return dense_reaches(theta, *boundary, 0.0, turn);
    }
    *boundary = rises ? branch->upper : branch->lower;
    const bool passed = rises ? step->theta_end > *boundary : step->theta_end < *boundary;
    return passed ? dense_reaches(theta, *boundary, turn, 1.0) : 2.0;
}

/* Takes the samples up to `end` in the step of size h from `time`; returns the number of the next sample. */
static int take_samples(Equation *equation, const Branch *branch, const Step *step, double time, double h, double end,
                        int next, Sample *samples)
{
    for (; next < SAMPLES && next * sample_interval <= end; ++next) {
        const double s = (next * sample_interval - time) / h;
        Sample *sample = &samples[next];
        sample->theta = dense_at(step->theta_dense, s);
        sample->omega = dense_at(step->omega_dense, s);
        sample->alpha = acceleration(equation, branch, sample->theta, sample->omega);
    }
    return next;
}

/* x^(-1/5) within 1.2 %, between values of it that no step size uses. A double read as a whole number is its binary
 * logarithm in units of 2^-52, but for an offset and with straight lines between the powers of 2. */
static double inverse_fifth_root(double x)
{
    const double bounded = x > 1e-5 ? (x < 1e6 ? x : 1e6) : 1e-5;
    const int64_t one = (int64_t)1023 << 52, digits = ((int64_t)1 << 52) - 1;
    int64_t bits;
    memcpy(&bits, &bounded, sizeof bits);
    bits = (int64_t)(1.2 * (double)one - 0.2 * (double)bits);
    double power, mantissa;
    memcpy(&power, &bits, sizeof power);
    bits = (bits & digits) | one;
    memcpy(&mantissa, &bits, sizeof mantissa);
    return power * (0.9955 - 0.245 * (mantissa - 1.0) * (2.0 - mantissa));
}

/* Starts at rest at theta. Returns false if the steps become too small. */
static bool simulate(Equation *equation, double theta, double tolerance, Sample *samples)
{
    Branch *branch = equation->branch;
    while (theta >= branch->upper)
        ++branch;
    double time = 0.0, omega = 0.0, h = first_step;
    Step step;
    step.alpha[0] = acceleration(equation, branch, theta, omega);
    for (int next = 0; next < SAMPLES;) {
        take_stages(equation, branch, theta, omega, h, &step);
        const double error =
            h / tolerance * fmax(fabs(error_of(step.omega)), omega_weight * fabs(error_of(step.alpha)));
        const double factor = fmax(0.1, fmin(5.0, 0.9 * inverse_fifth_root(error)));
        if (!(error <= 1.0)) {
            h *= error < INFINITY ? factor : 0.1;
            if (h < smallest_step)
                return false;
            continue;
        }
        make_dense(theta, step.theta_end, step.omega, h, step.theta_dense);
        make_dense(omega, step.omega_end, step.alpha, h, step.omega_dense);
        double boundary;
        const double part = find_exit(branch, &step, &boundary);
        const double end = time + fmin(part, 1.0) * h;
        next = take_samples(equation, branch, &step, time, h, end, next, samples);
        time = end;
        branch->step = h *= factor;
        if (part <= 1.0) {
            theta = boundary;
            omega = dense_at(step.omega_dense, part);
            branch += boundary == branch->upper ? 1 : -1;
            h = branch->step > 0.0 ? branch->step : h;
            step.alpha[0] = acceleration(equation, branch, theta, omega);
        } else {
            theta = step.theta_end;
            omega = step.omega_end;
            step.alpha[0] = step.alpha[6];
        }
    }
    return true;
}

typedef struct {
    Joystick joystick;
    double theta_start, tolerance;
    Sample samples[SAMPLES];
    unsigned long evaluations;
} Job;

static bool run(void *context)
{
    Job *job = context;
    Equation equation;
    equation_of(&job->joystick, &equation);
    const bool done = simulate(&equation, job->theta_start, job->tolerance, job->samples);
    job->evaluations = equation.evaluations;
    return done;
}

int main(int argc, char *argv[])
{
    static Job job;
    if ((argc != 6 && argc != 7) || (strcmp(argv[1], "constant") != 0 && strcmp(argv[1], "power-law") != 0)) {
        fprintf(stderr, "usage: %s constant|power-law TOLERANCE THETA_START BATCHES RUNS [SAMPLES_FILE]\n", argv[0]);
        return EXIT_FAILURE;
    }
    job.joystick = paper_joystick;
    job.joystick.power_law = strcmp(argv[1], "power-law") == 0;
    job.tolerance = number_argument("TOLERANCE", argv[2]);
    job.theta_start = number_argument("THETA_START", argv[3]);
    const size_t batches = count_argument("BATCHES", argv[4], 1), runs = count_argument("RUNS", argv[5], 1);
    const double seconds = measure(run, &job, batches, runs);
    print_result(seconds, job.samples, SAMPLES, job.evaluations);
    if (argc == 7)
        write_samples(argv[6], job.samples, SAMPLES);
    return EXIT_SUCCESS;
}
