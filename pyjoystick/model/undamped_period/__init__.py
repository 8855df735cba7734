"""The period of an undamped oscillation, from the energy and in closed form: the paper's main finding."""
