model UnknownParameter "A parameter that the initial equations should determine, but do not"
  parameter Real k(fixed=false); // here
  Real x(start=1, fixed=true);
equation
  der(x) = -k*x;
end UnknownParameter;
