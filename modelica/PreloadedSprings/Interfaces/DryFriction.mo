within PreloadedSprings.Interfaces;
partial model DryFriction "Dry friction of the pivot and of the plunger in contact: bounds of the friction moment"
  parameter Units.Torque T_c(min = 0) = 0 "Coulomb friction moment of the pivot"
    annotation (Dialog(group = "Pivot"));
  parameter Units.Torque T_s(min = 0) = 0 "Static friction moment of the pivot; 0 stands for T_c"
    annotation (Dialog(group = "Pivot"));
  parameter Units.AngularVelocity omega_s(min = 0) = 0 "Stribeck velocity, over which T_s falls to T_c"
    annotation (Dialog(group = "Pivot"));
  parameter Units.Force F_c(min = 0) = 0 "Coulomb friction force along the plunger in contact"
    annotation (Dialog(group = "Plungers"));
  parameter Units.Length a(min = Constants.small, start = 0.02398) "Distance from the pivot to the plunger axes"
    annotation (Dialog(group = "Plungers"));
  parameter Units.Length b(start = 0.005) "Distance from the pivot to the cam surface"
    annotation (Dialog(group = "Plungers"));
  RotationalFlange flange "Shaft that rubs"
    annotation (Placement(transformation(extent = {{-110, -10}, {-90, 10}})));
  Signals.AngularVelocityInput omega "Angular velocity of the shaft"
    annotation (Placement(transformation(origin = {0, 110}, extent = {{-10, -10}, {10, 10}}, rotation = -90)));
  Signals.BooleanInput isForwardInContact "True where the plate pushes the forward plunger"
    annotation (Placement(transformation(origin = {60, -110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
  Signals.BooleanInput isBackwardInContact "True where the plate pushes the backward plunger"
    annotation (Placement(transformation(origin = {-60, -110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
  Signals.TorqueOutput M_f "Friction moment, against the motion"
    annotation (Placement(transformation(extent = {{100, 40}, {120, 60}})));
  Units.Torque M_max "Largest friction moment while stuck";
  Units.Torque M_slide "Magnitude of the friction moment while sliding";
  Units.Torque M_stribeck "Share of M_slide that falls with the speed";
protected
  final parameter Units.Torque T_more = if T_s > T_c then T_s - T_c else 0
    "What the static moment adds to the Coulomb moment";
  final parameter Units.AngularVelocity omega_more = if omega_s > 0 then omega_s else Constants.small
    "Stribeck velocity as a divisor";
  Units.Ratio s "Sine of the angle";
  Units.Length lever "abs(dx/dtheta) of the plunger in contact";
equation
  s = sin(flange.phi);
  lever = if isForwardInContact then (a - b*s)/((1 - s)*(1 + s))
    elseif isBackwardInContact then (a + b*s)/((1 - s)*(1 + s)) else 0;
  M_max = T_c + T_more + F_c*lever;
  M_slide = T_c + M_stribeck + F_c*lever;
  flange.tau = M_f;
initial equation
  assert(T_c >= 0, getInstanceName() + ".T_c must not be negative, but is " + String(T_c) + " N.m");
  assert(F_c >= 0, getInstanceName() + ".F_c must not be negative, but is " + String(F_c) + " N");
  assert(T_s >= T_c or T_s == 0, getInstanceName() + ".T_s must be 0 or at least T_c = " + String(T_c)
     + " N.m, but is " + String(T_s) + " N.m");
  assert(omega_s > 0 or T_s <= T_c, getInstanceName() + ".omega_s must be positive where T_s exceeds T_c, but is "
     + String(omega_s) + " rad/s");

  annotation (
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-80, 80}, {80, -80}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{-90, 0}, {-50, 0}}, color = {64, 64, 64}, thickness = 0.5),
      Rectangle(extent = {{-50, 14}, {10, -14}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Rectangle(extent = {{-30, -14}, {50, -26}}, lineColor = {64, 64, 64}, fillColor = {235, 235, 235},
        fillPattern = FillPattern.Solid),
      Line(points = {{-24, -38}, {-12, -26}}, color = {64, 64, 64}),
      Line(points = {{0, -38}, {12, -26}}, color = {64, 64, 64}),
      Line(points = {{24, -38}, {36, -26}}, color = {64, 64, 64}),
      Text(extent = {{20, -86}, {140, -116}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>Dry friction acts against the motion with the moment</p>
<blockquote><code>M_slide = T_c + (T_s - T_c)*exp(-(omega/omega_s)^2) + F_c*abs(dx/dtheta)</code></blockquote>
<p>while the shaft slides: Coulomb friction <code>T_c</code> of the pivot; Stribeck friction, where the static moment
<code>T_s</code> is larger; and Coulomb friction <code>F_c</code> along the plunger that the plate pushes. The plunger
acts through the lever of its contact, as in <code>M_s = f_x*dx/dtheta</code>; within the clearance none is pushed and
<code>F_c</code> has no effect. The plunger is assumed to follow the plate, which requires a spring force above
<code>F_c</code>; this is reached within the first fraction of a micrometer of contact.</p>
<p>While the shaft sticks, the moment balances all others, up to <code>M_max</code>, which is
<code>M_slide</code> at rest. All parameters are zero by default: there is no dry friction then.</p>
<p>The paper has no dry friction. Coulomb's and Stribeck's laws are those of
<code>Modelica.Mechanics.Rotational.Components.BearingFriction</code>.</p>
</html>"));
end DryFriction;
