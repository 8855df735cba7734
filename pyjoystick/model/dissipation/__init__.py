"""Where a free oscillation leaves its energy: the steps of Fig. 12, and the damping function of Fig. 13."""
