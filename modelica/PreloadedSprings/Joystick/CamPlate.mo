within PreloadedSprings.Joystick;
model CamPlate "Plate that turns with the handle and pushes one of two plungers (eqs. 2-5)"
  parameter PreloadedSprings.Units.Length a(start = 0.02398) "Distance from the pivot to the plunger axes";
  parameter PreloadedSprings.Units.Length b(start = 0.005) "Distance from the pivot to the cam surface";
  PreloadedSprings.Interfaces.RotationalFlange flange "Shaft of the plate"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  PreloadedSprings.Interfaces.TranslationalFlange flange_forward "Contact with the plunger at positive angles"
    annotation (Placement(transformation(extent = {{50, -110}, {70, -90}})));
  PreloadedSprings.Interfaces.TranslationalFlange flange_backward "Contact with the plunger at negative angles"
    annotation (Placement(transformation(extent = {{-70, -110}, {-50, -90}})));
  PreloadedSprings.Interfaces.Signals.PositionOutput x "Travel of the contact, positive for any angle"
    annotation (Placement(transformation(extent = {{100, 70}, {120, 90}})));
  PreloadedSprings.Interfaces.Signals.ForceOutput f_x "Contact force along the plunger axis"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
  PreloadedSprings.Interfaces.Signals.TorqueOutput M_s "Moment of the contact force about the pivot"
    annotation (Placement(transformation(extent = {{100, -90}, {120, -70}})));
  PreloadedSprings.Interfaces.Signals.BooleanOutput isForward "True where the angle is positive"
    annotation (Placement(transformation(origin = {0, 110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
protected
  Real t(unit = "1") "Slope of the plate, tan(phi)";
  Real u(unit = "1") "tan(phi/2)";
equation
  t = tan(flange.phi);
  u = tan(flange.phi/2);
  flange_forward.s = t*(a - b*u);
  flange_backward.s = -t*(a + b*u);
  M_s = -flange_forward.f*(a + (flange_forward.s - b)*t) - flange_backward.f*(-a + (flange_backward.s - b)*t);
  flange.tau = M_s;
  isForward = flange.phi > 0;
  x = if isForward then flange_forward.s else flange_backward.s;
  f_x = -(flange_forward.f + flange_backward.f);
initial equation
  assert(a > 0, getInstanceName() + ".a must be positive, but is " + String(a) + " m");
  assert(b >= 0, getInstanceName() + ".b must not be negative, but is " + String(b) + " m");
end CamPlate;
