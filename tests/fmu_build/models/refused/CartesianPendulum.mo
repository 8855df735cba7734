model CartesianPendulum "A pendulum in Cartesian coordinates: its states are constrained"
  Real x(start=1), y(start=0);
  Real vx(start=0, fixed=true), vy(start=0, fixed=true);
  Real tension;
equation
  der(x) = vx;
  der(y) = vy;
  der(vx) = -tension*x;
  der(vy) = -tension*y - 9.81;
  x^2 + y^2 = 1;
end CartesianPendulum;
