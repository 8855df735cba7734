model Delayed "A delayed signal"
  Real x(start=0, fixed=true);
  Real y;
equation
  der(x) = 1;
  y = delay(x, 0.1); // here
end Delayed;
