within PreloadedSprings.Joystick;
model Gravity "Moment of the handle's weight about the pivot"
  parameter PreloadedSprings.Units.Mass m(start = 0.87) "Mass of the handle";
  parameter PreloadedSprings.Units.Length h(start = 0.082) "Distance from the pivot to the center of mass";
  parameter PreloadedSprings.Units.Acceleration g(min = 0) = 9.80665 "Acceleration of gravity";
  PreloadedSprings.Interfaces.RotationalFlange flange "Shaft of the handle"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  PreloadedSprings.Interfaces.Signals.TorqueOutput M_g "Moment of the weight, in the direction of the angle"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
  PreloadedSprings.Units.Energy E "Potential energy, zero in the upright position";
equation
  M_g = m*g*h*sin(flange.phi);
  flange.tau = -M_g;
  E = -2*m*g*h*sin(flange.phi/2)^2;
initial equation
  assert(m > 0, getInstanceName() + ".m must be positive, but is " + String(m) + " kg");
  assert(h >= 0, getInstanceName() + ".h must not be negative, but is " + String(h) + " m");
  assert(g >= 0, getInstanceName() + ".g must not be negative, but is " + String(g) + " m/s2");
end Gravity;
