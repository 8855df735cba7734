within PreloadedSprings.Operator;
block HandArm "Torque of a hand and arm that are drawn to a wanted angle"
  parameter Units.RotationalStiffness K = 25 "Stiffness of hand and arm about the joystick's pivot";
  parameter Units.RotationalDamping D = 0.7 "Damping of hand and arm about the joystick's pivot";
  Interfaces.Signals.AngleInput theta_ref "Wanted angle"
    annotation (Placement(transformation(extent = {{-120, 70}, {-100, 90}})));
  Interfaces.Signals.AngularVelocityInput omega_ref "Wanted angular velocity"
    annotation (Placement(transformation(extent = {{-120, 20}, {-100, 40}})));
  Interfaces.Signals.AngleInput theta "Angle of the joystick"
    annotation (Placement(transformation(extent = {{-120, -40}, {-100, -20}})));
  Interfaces.Signals.AngularVelocityInput omega "Angular velocity of the joystick"
    annotation (Placement(transformation(extent = {{-120, -90}, {-100, -70}})));
  Interfaces.Signals.TorqueOutput T "Torque on the joystick"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
equation
  T = K*(theta_ref - theta) + D*(omega_ref - omega);
initial equation
  assert(K >= 0, getInstanceName() + ".K must not be negative, but is " + String(K) + " N.m/rad");
  assert(D >= 0, getInstanceName() + ".D must not be negative, but is " + String(D) + " N.m.s/rad");

  annotation (
    defaultComponentName = "handArm",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {0, 0, 127}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{-70, 60}, {-70, -60}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{70, 60}, {70, -60}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{-70, 30}, {-44, 30}, {-34, 50}, {-18, 10}, {0, 50}, {18, 10}, {34, 50}, {44, 30}, {70, 30}},
        color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{-70, -30}, {-6, -30}}, color = {64, 64, 64}, thickness = 0.5),
      Rectangle(extent = {{-6, -14}, {10, -46}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{70, -30}, {30, -30}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{-24, -8}, {30, -8}, {30, -52}, {-24, -52}}, color = {64, 64, 64}, thickness = 0.5),
      Text(extent = {{-150, 140}, {150, 105}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The mechanical impedance of hand and arm without their mass: a spring and a damper between the wanted angle and
the actual one, <code>T = K*(theta_ref - theta) + D*(omega_ref - omega)</code>. The mass of the hand moves with the
handle; add its moment of inertia to the <code>J</code> of the joystick.</p>
<p>The preset <code>K</code> is a stiffness at the hand of 350 N/m at the top of the handle, 0.266 m from the pivot:
the stiffness of a hand that holds a posture is some hundred N/m (F. A. Mussa-Ivaldi, N. Hogan and E. Bizzi,
J. Neurosci. 5 (1985) 2732-2743). The preset <code>D</code> is this library's choice: with the joystick's moment of
inertia it lets the joystick follow with little overshoot.</p>
</html>"));
end HandArm;
