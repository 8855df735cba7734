model BooleanLoop "Booleans that depend on each other at the same instant"
  Boolean a, b;
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
  a = not b; // here
  b = not a and x > 0.5;
end BooleanLoop;
