"""The part of the Modelica Standard Library that `fmu_build` builds, and whether the results are right."""
