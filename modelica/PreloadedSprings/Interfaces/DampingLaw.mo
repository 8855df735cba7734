within PreloadedSprings.Interfaces;
partial model DampingLaw "Viscous damping of a rotation with a coefficient that an extending class gives"
  PreloadedSprings.Interfaces.RotationalFlange flange "Shaft that is damped"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  PreloadedSprings.Interfaces.Signals.AngularVelocityInput omega "Angular velocity of the shaft"
    annotation (Placement(transformation(origin = {0, 110}, extent = {{-10, -10}, {10, 10}}, rotation = -90)));
  PreloadedSprings.Interfaces.Signals.BooleanInput isForward "True where the angle of the shaft is positive"
    annotation (Placement(transformation(origin = {0, -110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
  PreloadedSprings.Interfaces.Signals.RotationalDampingOutput coefficient "Damping coefficient"
    annotation (Placement(transformation(extent = {{100, 40}, {120, 60}})));
  PreloadedSprings.Interfaces.Signals.TorqueOutput M_d "Damping moment"
    annotation (Placement(transformation(extent = {{100, -60}, {120, -40}})));
equation
  M_d = coefficient*omega;
  flange.tau = M_d;
end DampingLaw;
