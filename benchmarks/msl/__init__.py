"""How much of the Modelica Standard Library `fmu_build` builds, and whether the results are right."""
