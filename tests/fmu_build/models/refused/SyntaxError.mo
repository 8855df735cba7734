model SyntaxError "A closing parenthesis is missing"
  Real x(start=0, fixed=true; // here
equation
  der(x) = 1;
end SyntaxError;
