within PreloadedSprings.Joystick;
block Stops "Mechanical stops on both sides: stiff springs with damping that push and never pull"
  parameter Units.Angle theta_stop(min = 0, max = Constants.pi/2) = 0
    "Angle at which the handle meets a stop, to either side; 0: no stops"
    annotation (Dialog(group = "Stops"));
  parameter Units.RotationalStiffness K(min = 0) = 1000 "Stiffness of a stop about the pivot"
    annotation (Dialog(group = "Stops"));
  parameter Units.RotationalDamping D(min = 0) = 0.7 "Damping of a stop about the pivot"
    annotation (Dialog(group = "Stops"));
  Interfaces.Signals.AngleInput theta "Angle of the handle"
    annotation (Placement(transformation(extent = {{-120, 40}, {-100, 60}})));
  Interfaces.Signals.AngularVelocityInput omega "Angular velocity of the handle"
    annotation (Placement(transformation(extent = {{-120, -60}, {-100, -40}})));
  Interfaces.Signals.BooleanInput isForward "True where the angle is positive"
    annotation (Placement(transformation(origin = {0, -110}, extent = {{-10, -10}, {10, 10}}, rotation = 90)));
  Interfaces.Signals.TorqueOutput M_stop "Moment of the stop, against positive angles"
    annotation (Placement(transformation(extent = {{100, -10}, {120, 10}})));
  Units.Angle delta "Compression of the stop, negative away from it";
  Units.Torque push "What spring and damper of the stop would exert together, outward compression positive";
  Units.Energy E "Energy of the compressed stop";
  Boolean isMet "True where the handle is beyond the angle of a stop";
  Boolean isPushing "True where spring and damper together push";
protected
  constant Units.Angle theta_limit = Constants.pi/2 "Angle at which the handle lies flat";
  // Without stops neither relation ever changes: there are no events.
  final parameter Units.Angle theta_meet = if theta_stop > 0 then theta_stop else 1e9
    "Angle of the stops, out of reach where there are none";
equation
  delta = (if isForward then theta else -theta) - theta_meet;
  push = K*delta + D*(if isForward then omega else -omega);
  isMet = delta > 0;
  isPushing = push > 0;
  M_stop = if isMet and isPushing then (if isForward then push else -push) else 0;
  E = if isMet then K*delta^2/2 else 0;
initial equation
  assert(theta_stop >= 0 and theta_stop < theta_limit, getInstanceName()
     + ".theta_stop must not be negative and below pi/2, but is " + String(theta_stop) + " rad");
  assert(K > 0, getInstanceName() + ".K must be positive, but is " + String(K) + " N.m/rad");
  assert(D >= 0, getInstanceName() + ".D must not be negative, but is " + String(D) + " N.m.s/rad");

  annotation (
    defaultComponentName = "stops",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-100, 100}, {100, -100}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{0, -60}, {34, 40}}, color = {64, 64, 64}, thickness = 1),
      Rectangle(extent = {{44, 60}, {64, 10}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Rectangle(extent = {{-64, 60}, {-44, 10}}, lineColor = {64, 64, 64}, fillColor = {192, 192, 192},
        fillPattern = FillPattern.Solid),
      Text(extent = {{20, -86}, {140, -116}}, textColor = {0, 0, 255}, textString = "%name")}),
    Documentation(info = "<html>
<p>The joystick meets its stops at about 20 degrees to either side. Each is a spring and a damper that act only
while they are pushed. With the compression <code>delta = abs(theta) - theta_stop</code> and its rate
<code>delta'</code> the moment against the motion outward is</p>
<blockquote><code>K*delta + D*delta'</code> where <code>delta &gt; 0</code> and the sum is positive, else 0.
</blockquote>
<p>At the impact the moment jumps by <code>D*delta'</code>; when the handle leaves, it falls to zero before the
compression does, because a stop does not hold the handle back. Both are state events. An impact returns the speed
times</p>
<blockquote><code>exp(-zeta/sqrt(1 - zeta^2)*arctan2(2*zeta*sqrt(1 - zeta^2), 2*zeta^2 - 1))</code>,
<code>zeta = D/(2*sqrt(K*J))</code>,</blockquote>
<p>for <code>zeta &lt; 1</code>, where other moments are small beside that of the stop. What remains of the energy
<code>K*delta^2/2</code> when the handle leaves is lost with the rest of the damping.</p>
<p>The paper does not describe the stops. The preset <code>K</code> is this library's choice: a handle of 0.27 m
yields by 1 mm under 14 N at its top; with the preset <code>D</code> and the paper's <code>J</code> an impact returns
0.74 of the speed. The preset <code>theta_stop = 0</code> means no stops.</p>
</html>"));
end Stops;
