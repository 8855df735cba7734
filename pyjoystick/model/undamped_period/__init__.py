"""How long an undamped oscillation takes, from the energy and in closed form: the paper's main finding."""
