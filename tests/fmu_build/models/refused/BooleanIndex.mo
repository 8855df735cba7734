model BooleanIndex "An array whose index is a Boolean"
  Real x[Boolean]; // here
equation
  x[false] = 1;
  x[true] = time;
end BooleanIndex;
