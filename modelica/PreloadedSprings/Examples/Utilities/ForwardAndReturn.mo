within PreloadedSprings.Examples.Utilities;
block ForwardAndReturn "One smooth motion forward and back"
  parameter Units.Angle theta_max(start = 0.25) "Largest angle";
  parameter Units.Time start_time = 0 "Time at which the motion begins";
  parameter Units.Time duration(min = Constants.small, start = 0.3) "Time that the motion takes";
  Interfaces.Signals.AngleOutput theta "Angle"
    annotation (Placement(transformation(extent = {{100, 50}, {120, 70}})));
  Interfaces.Signals.AngularVelocityOutput omega "Angular velocity"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
  Interfaces.Signals.AngularAccelerationOutput alpha "Angular acceleration"
    annotation (Placement(transformation(extent = {{100, -70}, {120, -50}})));
protected
  final parameter Units.AngularVelocity w = Constants.pi/duration "Rate of the motion's phase";
  Units.Angle phase "Phase, from 0 to pi during the motion";
  Units.Ratio s "Sine of the phase";
  Units.Ratio c "Cosine of the phase";
equation
  phase = if time < start_time then 0 elseif time < start_time + duration then w*(time - start_time) else Constants.pi;
  s = sin(phase);
  c = cos(phase);
  theta = theta_max*s^4;
  omega = 4*theta_max*w*s^3*c;
  alpha = 4*theta_max*w^2*s^2*(3*c^2 - s^2);
initial equation
  assert(duration > 0, getInstanceName() + ".duration must be positive, but is " + String(duration) + " s");

  annotation (
    defaultComponentName = "motion",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {0, 0, 127}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{-88, -60}, {14, -60}}, color = {192, 192, 192}),
      Line(points = {{-88, -60}, {-72, -58}, {-64, -46}, {-57, -20}, {-50, 14}, {-44, 42}, {-38, 52},
        {-32, 42}, {-26, 14}, {-19, -20}, {-12, -46}, {-4, -58}, {14, -60}}, color = {0, 0, 127}, thickness = 0.5),
      Text(extent = {{30, 72}, {98, 48}}, textColor = {0, 0, 127}, textString = "theta"),
      Text(extent = {{30, 12}, {98, -12}}, textColor = {0, 0, 127}, textString = "omega"),
      Text(extent = {{30, -48}, {98, -72}}, textColor = {0, 0, 127}, textString = "alpha"),
      Text(extent = {{-150, 140}, {150, 105}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The angle follows the fourth power of a half-wave of a sine, so that its first three derivatives are
continuous at both ends of the motion. Angular velocity and acceleration are its exact derivatives.</p>
</html>"));
end ForwardAndReturn;
