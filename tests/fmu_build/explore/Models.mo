package Models "Models for pages: not a joystick among them"
  model Ball "A ball that bounces </script><b>on a floor</b>"
    parameter Real e(min = 0, max = 1) = 0.8 "Coefficient of <i>restitution</i>";
    parameter Real g(unit = "m/s2") = 9.81 "Gravity & no more";
    Real h(start = 1, fixed = true, unit = "m") "Height";
    Real v(start = 0, fixed = true, unit = "m/s") "Velocity";
    Boolean isFlying(start = true, fixed = true) "False at rest";
    Integer bounces(start = 0, fixed = true) "Number of bounces";
  equation
    der(h) = v;
    der(v) = if isFlying then -g else 0;
    when h < 0 then
      reinit(v, if -e * pre(v) > 0.01 then -e * pre(v) else 0);
      isFlying = -e * pre(v) > 0.01;
      bounces = pre(bounces) + 1;
    end when;
    annotation(experiment(StopTime = 3, Interval = 0.005));
  end Ball;

  model Chain "Two masses in a row between springs"
    type Kind = enumeration(soft "Soft spring", hard "Hard spring");
    parameter Real m[2](each unit = "kg", each min = 0.01) = {1, 2} "Masses";
    parameter Real k(unit = "N/m", min = 0) = 100 "Stiffness";
    parameter Kind kind = Kind.soft "Kind of the spring in the middle";
    parameter Integer strands(min = 1, max = 5) = 2 "Number of parallel springs";
    input Real F(unit = "N") "Force on the first mass";
    output Real x[2](each unit = "m", each displayUnit = "mm", each start = 0, each fixed = true) "Displacements";
    Real v[2](each unit = "m/s", each start = 0, each fixed = true) "Velocities";
    Real f(unit = "N") "Force of the spring in the middle";
  equation
    f = strands * (if kind == Kind.hard then 10 * k else k) * (x[2] - x[1]);
    der(x) = v;
    m[1] * der(v[1]) = F + f - k * x[1] - v[1];
    m[2] * der(v[2]) = -f - v[2];
    assert(abs(x[1]) < 10, "x[1] left the room");
    annotation(experiment(StopTime = 4, Interval = 0.01));
  end Chain;
end Models;
