model DiscreteArray "Booleans that are given as an array"
  Real x(start=0, fixed=true);
  Boolean above[2]; // here
equation
  der(x) = 1;
  above = {x > 0.3, x > 0.7};
end DiscreteArray;
