model InputDerivative "The derivative of an input"
  input Real u;
  output Real y;
equation
  y = der(u); // here
end InputDerivative;
