model ParameterFromTime "A parameter that depends on the time at which the run starts"
  parameter Real origin(fixed = false);
  Real x(start = 0, fixed = true);
initial algorithm
  origin := 2*time;
equation
  der(x) = time - origin;
end ParameterFromTime;
