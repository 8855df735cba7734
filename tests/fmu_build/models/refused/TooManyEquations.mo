model TooManyEquations "Two equations for one unknown"
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
  x = 2*time;
end TooManyEquations;
