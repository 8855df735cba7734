within PreloadedSprings.Interfaces;
partial model DampingLaw "Viscous damping of a shaft with a coefficient that an extending class gives"
  RotationalFlange flange "Shaft that is damped"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  Signals.AngularVelocityInput omega "Angular velocity of the shaft"
    annotation (Placement(transformation(origin = {0, 110}, extent = {{-10, -10}, {10, 10}}, rotation = -90)));
  Signals.BooleanInput isForward "True where the angle of the shaft is positive"
    annotation (Placement(transformation(origin = {0, -110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
  Signals.RotationalDampingOutput coefficient "Damping coefficient"
    annotation (Placement(transformation(extent = {{100, 40}, {120, 60}})));
  Signals.TorqueOutput M_d "Damping moment, against the angular velocity"
    annotation (Placement(transformation(extent = {{100, -60}, {120, -40}})));
equation
  M_d = coefficient*omega;
  flange.tau = M_d;

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-80, 80}, {80, -80}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{-90, 0}, {-20, 0}}, color = {64, 64, 64}, thickness = 0.5),
      Line(points = {{40, 36}, {-40, 36}, {-40, -36}, {40, -36}}, color = {64, 64, 64}, thickness = 0.5),
      Rectangle(extent = {{-20, 26}, {4, -26}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Line(points = {{-40, -36}, {-40, -56}}, color = {64, 64, 64}),
      Text(extent = {{20, -86}, {140, -116}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The moment is <code>M_d = coefficient*omega</code>, the second term of eq. (1). An extending class gives the
coefficient as a function of the angle <code>flange.phi</code>, of <code>omega</code> and of the side
<code>isForward</code>.</p>
<p>Angular velocity and side are inputs, not derived here: the same law then serves where the motion is
computed and where it is prescribed, and the sign of the angle is tested in one place only, so that its
change is one state event.</p>
</html>"));
end DampingLaw;
