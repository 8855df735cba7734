model StartFromInput "A start value that depends on an input"
  input Real u(start=3);
  Real x(start=u, fixed=true); // here
equation
  der(x) = u;
end StartFromInput;
