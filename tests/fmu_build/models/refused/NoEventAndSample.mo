model NoEventAndSample "Relations with a sampled variable, with and without events"
  discrete Real d(start=0.5, fixed=true);
  Real x(start=0, fixed=true);
  Real y;
  Boolean b;
equation
  der(x) = 1;
  when sample(0.2, 1) then
    d = 0.7;
  end when;
  b = x > d;
  y = noEvent(if x > d then 1 else 2);
end NoEventAndSample;
