model SwitchedConstraint "The ratio between two states depends on the motion"
  Real a(start=0.2, fixed=true), b, v(start=1, fixed=true), w, F;
equation
  der(a) = v;
  der(b) = w;
  der(v) = -F - a;
  der(w) = F;
  a = if a > 0 then 2*b else b;
end SwitchedConstraint;
