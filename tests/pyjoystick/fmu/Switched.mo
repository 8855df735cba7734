model Switched "Inputs of three types"
  input Real u;
  input Integer n;
  input Boolean on;
  output Real x(start=0, fixed=true) "Integral of n*u while it is on";
equation
  der(x) = if on then n*u else 0;
end Switched;
