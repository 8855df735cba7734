model SecondDerivative "A derivative of a derivative"
  Real x(start=1, fixed=true);
equation
  der(der(x)) = -x; // here
end SecondDerivative;
