model UnknownVariable "A variable that does not exist"
  Real x;
equation
  x = missing_variable + 1; // here
end UnknownVariable;
