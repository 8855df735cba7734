model WrongType "Adds a Boolean to a number"
  Real x;
  Boolean b;
equation
  b = time > 0.1;
  x = b + 1; // here
end WrongType;
