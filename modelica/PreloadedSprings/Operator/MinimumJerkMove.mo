within PreloadedSprings.Operator;
block MinimumJerkMove "Smooth move to an angle and back, with a pause between"
  parameter Units.Angle theta_target(start = 0.25) "Angle at which the move pauses";
  parameter Units.Time start_time = 0 "Time at which the move begins";
  parameter Units.Time move_time(min = Constants.small, start = 0.3) "Time for either way";
  parameter Units.Time pause(min = 0) = 0 "Time between the ways";
  Interfaces.Signals.AngleOutput theta "Angle"
    annotation (Placement(transformation(extent = {{100, 30}, {120, 50}})));
  Interfaces.Signals.AngularVelocityOutput omega "Angular velocity"
    annotation (Placement(transformation(extent = {{100, -50}, {120, -30}})));
protected
  final parameter Units.Time return_time = start_time + move_time + pause "Time at which the way back begins";
  Units.Ratio s "Share of the way there that is over in time, from 0 to 1";
  Units.Ratio r "Share of the way back that is over in time, from 0 to 1";
equation
  s = if time < start_time then 0 elseif time < start_time + move_time then (time - start_time)/move_time else 1;
  r = if time < return_time then 0 elseif time < return_time + move_time then (time - return_time)/move_time else 1;
  theta = theta_target*(s^3*(10 - 15*s + 6*s^2) - r^3*(10 - 15*r + 6*r^2));
  omega = theta_target/move_time*30*(s^2*(1 - s)^2 - r^2*(1 - r)^2);
initial equation
  assert(move_time > 0, getInstanceName() + ".move_time must be positive, but is " + String(move_time) + " s");
  assert(pause >= 0, getInstanceName() + ".pause must not be negative, but is " + String(pause) + " s");

  annotation (
    defaultComponentName = "move",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {0, 0, 127}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{-88, -60}, {30, -60}}, color = {192, 192, 192}),
      Line(points = {{-88, -60}, {-80, -60}, {-72, -52}, {-64, -5}, {-56, 42}, {-48, 50}, {-28, 50}, {-20, 42},
        {-12, -5}, {-4, -52}, {4, -60}, {30, -60}}, color = {0, 0, 127}, thickness = 0.5),
      Text(extent = {{40, 52}, {98, 28}}, textColor = {0, 0, 127}, textString = "theta"),
      Text(extent = {{40, -28}, {98, -52}}, textColor = {0, 0, 127}, textString = "omega"),
      Text(extent = {{-150, 140}, {150, 105}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>Either way is the polynomial <code>10*s^3 - 15*s^4 + 6*s^5</code> of the time <code>s</code> that has
passed, as a share of <code>move_time</code>: of all moves between two points of rest it has the smallest integral of
the squared jerk, which describes point-to-point motions of the human hand well (T. Flash and N. Hogan, J. Neurosci.
5 (1985) 1688-1703). Angular velocity and acceleration are zero at both ends; the jerk is not continuous there.</p>
</html>"));
end MinimumJerkMove;
