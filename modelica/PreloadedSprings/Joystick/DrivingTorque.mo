within PreloadedSprings.Joystick;
model DrivingTorque "Torque that is applied to a shaft from outside"
  PreloadedSprings.Interfaces.Signals.TorqueInput T "Torque in the direction of positive angles"
    annotation (Placement(transformation(extent = {{-120, -10}, {-100, 10}})));
  PreloadedSprings.Interfaces.RotationalFlange flange "Driven shaft"
    annotation (Placement(transformation(extent = {{90, -10}, {110, 10}})));
equation
  flange.tau = -T;
end DrivingTorque;
