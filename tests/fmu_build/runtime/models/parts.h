/* parts.h - what the hand-written models have in common: variables in short, and definitions for the parts that a
 * model does not have. A model defines state_nominal, variables, y_start and p_start, root_texts and relations. */
#define ANY -INFINITY, INFINITY
#define TIME                                                                                                          \
    {"time", TYPE_REAL, STORE_TIME, 0, CAUSALITY_INDEPENDENT, VARIABILITY_CONTINUOUS, INITIAL_NONE, ANY}
#define STATE(name, i)                                                                                                \
    {name, TYPE_REAL, STORE_STATE_OR_ALGEBRAIC, i, CAUSALITY_OUTPUT, VARIABILITY_CONTINUOUS, INITIAL_EXACT, ANY}
#define DERIVATIVE(name, i)                                                                                           \
    {name, TYPE_REAL, STORE_DERIVATIVE, i, CAUSALITY_LOCAL, VARIABILITY_CONTINUOUS, INITIAL_CALCULATED, ANY}
#define OUTPUT(name, i)                                                                                               \
    {name, TYPE_REAL, STORE_STATE_OR_ALGEBRAIC, i, CAUSALITY_OUTPUT, VARIABILITY_CONTINUOUS, INITIAL_CALCULATED, ANY}
#define INPUT(name, i, ...)                                                                                           \
    {name, TYPE_REAL, STORE_PARAMETER, i, CAUSALITY_INPUT, VARIABILITY_CONTINUOUS, INITIAL_NONE, __VA_ARGS__}
#define PARAMETER(name, i, ...)                                                                                       \
    {name, TYPE_REAL, STORE_PARAMETER, i, CAUSALITY_PARAMETER, VARIABILITY_TUNABLE, INITIAL_EXACT, __VA_ARGS__}
#define DISCRETE(name, i)                                                                                             \
    {name, TYPE_REAL, STORE_PARAMETER, i, CAUSALITY_OUTPUT, VARIABILITY_DISCRETE, INITIAL_CALCULATED, ANY}

/* The tables that every model has; its others follow as designated initializers. */
#define LENGTH(ARRAY) (sizeof(ARRAY) / sizeof *(ARRAY))
#define TABLES(NAME)                                                                                                  \
    .name = NAME, .token = MODEL_TOKEN, .n_states = LENGTH(state_nominal), .n_y = N_Y, .n_p = N_P, .y_start = y_start, \
    .p_start = p_start, .state_nominal = state_nominal, .n_variables = LENGTH(variables), .variables = variables,     \
    .initial_event_slot = NO_SLOT, .homotopy_slot = NO_SLOT
#define ROOTS_AND_RELATIONS                                                                                           \
    .n_roots = LENGTH(root_texts), .root_texts = root_texts, .n_relations = LENGTH(relations), .relations = relations

#define NO_ALGEBRAICS                                                                                                 \
    bool model_algebraics(double time, double *y, const double *p)                                                    \
    {                                                                                                                 \
        (void)time, (void)y, (void)p;                                                                                 \
        return true;                                                                                                  \
    }
#define NO_TIME_RELATIONS                                                                                             \
    void model_time_relations(double time, const double *p, double *root)                                             \
    {                                                                                                                 \
        (void)time, (void)p, (void)root;                                                                              \
    }                                                                                                                 \
    void model_time_events(const double *p, double *when)                                                             \
    {                                                                                                                 \
        (void)p, (void)when;                                                                                          \
    }
#define NO_DEPENDENT_PARAMETERS                                                                                       \
    void model_dependent_parameters(double *p)                                                                        \
    {                                                                                                                 \
        (void)p;                                                                                                      \
    }
#define NO_INITIAL_EQUATIONS                                                                                          \
    void model_start_values(double time, double *y, double *p)                                                        \
    {                                                                                                                 \
        (void)time, (void)y, (void)p;                                                                                 \
    }                                                                                                                 \
    void model_initial_residual(double time, const double *y, const double *p, double *residual)                      \
    {                                                                                                                 \
        (void)time, (void)y, (void)p, (void)residual;                                                                 \
    }
#define NO_DISCRETE_EQUATIONS                                                                                         \
    void model_discrete(double time, const double *y, const double *p, double *value)                                 \
    {                                                                                                                 \
        (void)time, (void)y, (void)p, (void)value;                                                                    \
    }
#define NO_ACTIONS                                                                                                    \
    bool model_watched_actions(double time, double *y, const double *p, bool *due)                                    \
    {                                                                                                                 \
        (void)time, (void)y, (void)p;                                                                                 \
        *due = false;                                                                                                 \
        return true;                                                                                                  \
    }                                                                                                                 \
    void model_actions(double time, const double *y, const double *p, bool *active)                                   \
    {                                                                                                                 \
        (void)time, (void)y, (void)p, (void)active;                                                                   \
    }                                                                                                                 \
    void model_action_message(size_t action, double time, const double *y, const double *p, char *text, size_t size)  \
    {                                                                                                                 \
        (void)action, (void)time, (void)y, (void)p;                                                                   \
        if (size > 0)                                                                                                 \
            text[0] = '\0';                                                                                           \
    }
#define NO_ROOTS                                                                                                      \
    bool model_roots(double time, double *y, const double *p, double *root)                                           \
    {                                                                                                                 \
        (void)time, (void)y, (void)p, (void)root;                                                                     \
        return true;                                                                                                  \
    }
#define NO_TANGENTS                                                                                                   \
    void model_parameter_tangents(const double *p, double *dp)                                                        \
    {                                                                                                                 \
        (void)p, (void)dp;                                                                                            \
    }                                                                                                                 \
    bool model_tangents(double time, const double *y, const double *p, double dtime, double *dy, double *dp,          \
                        double *dder)                                                                                 \
    {                                                                                                                 \
        (void)time, (void)y, (void)p, (void)dtime, (void)dy, (void)dp, (void)dder;                                    \
        return false;                                                                                                 \
    }                                                                                                                 \
    void model_start_tangents(const double *y, const double *p, double *dy, const double *dp)                         \
    {                                                                                                                 \
        (void)y, (void)p, (void)dy, (void)dp;                                                                         \
    }                                                                                                                 \
    void model_initial_residual_tangents(double time, const double *y, const double *p, double dtime,                 \
                                         const double *dy, const double *dp, double *residual)                        \
    {                                                                                                                 \
        (void)time, (void)y, (void)p, (void)dtime, (void)dy, (void)dp, (void)residual;                                \
    }
