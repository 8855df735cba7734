model ContradictoryStart "A fixed start value and another initial equation for one state"
  Real x(start=0, fixed=true);
initial equation
  x = 1; // here
equation
  der(x) = 1;
end ContradictoryStart;
