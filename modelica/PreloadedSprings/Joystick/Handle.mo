within PreloadedSprings.Joystick;
model Handle "Inertia about the pivot, moving as told from outside"
  parameter PreloadedSprings.Units.MomentOfInertia J(start = 0.01135) "Mass moment of inertia about the pivot";
  PreloadedSprings.Interfaces.RotationalFlange flange "Shaft of the handle"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  PreloadedSprings.Interfaces.Signals.AngleInput theta "Angle"
    annotation (Placement(transformation(origin = {110, 80}, extent = {{-10, -10}, {10, 10}}, rotation = 180)));
  PreloadedSprings.Interfaces.Signals.AngularVelocityInput omega "Angular velocity"
    annotation (Placement(transformation(origin = {110, 0}, extent = {{-10, -10}, {10, 10}}, rotation = 180)));
  PreloadedSprings.Interfaces.Signals.AngularAccelerationInput alpha "Angular acceleration"
    annotation (Placement(transformation(origin = {110, -80}, extent = {{-10, -10}, {10, 10}}, rotation = 180)));
  PreloadedSprings.Units.Energy E "Kinetic energy";
equation
  flange.phi = theta;
  flange.tau = J*alpha;
  E = J*omega^2/2;
initial equation
  assert(J > 0, getInstanceName() + ".J must be positive, but is " + String(J) + " kg.m2");
end Handle;
