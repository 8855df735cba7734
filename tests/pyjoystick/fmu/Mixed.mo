model Mixed "Types other than Real, and a run that may fail"
  parameter Integer n(min = 1, max = 9) = 3 "Count";
  parameter Boolean inverted = false;
  parameter Real gain(min = -2, max = 2) = 1;
  parameter Real last = 1e9 "Time after which the model refuses to go on";
  input Real u(start = 0.5);
  output Real y;
  output Real integral(start = 0, fixed = true);
  output Integer steps;
  output Boolean above;
equation
  y = gain*u;
  der(integral) = u;
  steps = if integral > 1 then n else -n;
  above = if inverted then not (u > 1) else u > 1;
  assert(time < last, "past the last moment 100 % of #1");
end Mixed;
