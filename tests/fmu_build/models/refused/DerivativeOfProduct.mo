model DerivativeOfProduct "The derivative of an expression"
  Real x(start=2, fixed=true);
  Real rate;
equation
  der(x) = -x;
  rate = der(x*x); // here
end DerivativeOfProduct;
