model InitialDiscrete "An initial equation for a discrete variable itself"
  Real x(start=1, fixed=true);
  discrete Real d;
initial equation
  d = 5*x; // here
equation
  der(x) = -x;
  when x < 0.5 then
    d = time;
  end when;
end InitialDiscrete;
