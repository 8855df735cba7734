partial model Incomplete "A partial model"
  Real x(start=0, fixed=true);
equation
  der(x) = 1;
end Incomplete;
