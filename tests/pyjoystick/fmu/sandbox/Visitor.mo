model Visitor "Inputs and outputs of all types, and a run that may fail or end"
  parameter Integer n(min = 1, max = 9) = 3;
  parameter Boolean inverted = false;
  parameter Real start = 0;
  parameter Real last = 1e9 "Time after which the model refuses to go on";
  parameter Real goal = 1e9 "Integral at which the model ends the simulation";
  parameter Real hurry = 0 "The integral goes to infinity at the time 1/hurry";
  input Real u(start = 0.5);
  input Real v(start = 0);
  input Integer k(start = 1);
  input Boolean up(start = true);
  output Real integral(start = start, fixed = true);
  output Real y;
  output Integer steps;
  output Boolean above;
  Real w(start = hurry, fixed = true);
equation
  der(integral) = if up then u + v else -u;
  der(w) = w*w;
  y = k*integral;
  steps = if integral > 1 then n*k else -n;
  above = if inverted then not (u > 1) else u > 1;
  assert(time < last, "past the last moment 100 % of #1");
  when integral > goal then
    terminate("the goal is reached");
  end when;
end Visitor;
