model TooFewEquations "Two equations for three unknowns"
  Real x(start=0, fixed=true);
  Real y, z;
equation
  der(x) = y;
  y = z;
end TooFewEquations;
