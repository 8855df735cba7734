within PreloadedSprings.Friction;
model StickSlip "Dry friction of a shaft that slides or sticks"
  extends Interfaces.DryFriction;
  Interfaces.Signals.TorqueInput M "Moment of everything else on the shaft, towards positive angles"
    annotation (Placement(transformation(origin = {-60, 110}, extent = {{-10, -10}, {10, 10}}, rotation = -90)));
  Interfaces.Signals.BooleanOutput isStuck "True while the shaft sticks"
    annotation (Placement(transformation(extent = {{100, -60}, {120, -40}})));
  Integer mode(start = 0) "1: slides forward, -1: slides backward, 0: is stuck";
protected
  // Without friction there is nothing to decide, and rounding errors about a rest must not make events.
  final parameter Boolean isRubbing = T_c > 0 or T_s > 0 or F_c > 0 "True where there is friction";
  final parameter Units.AngularVelocity omega_never = if isRubbing then 0 else 1e9
    "Velocity that is never reached, where there is no friction";
  final parameter Units.Torque M_never = if isRubbing then 0 else 1e9
    "Moment that is never reached, where there is no friction";
  Boolean isForward "True where the angle rises";
  Boolean isBackward "True where the angle falls";
  Boolean isPushedForward "True where sticking cannot hold against a push towards positive angles";
  Boolean isPushedBackward "True where sticking cannot hold against a push towards negative angles";
equation
  // Only trial steps see a motion against the mode. With the friction at rest there, none leaps over its narrow peak.
  M_stribeck = T_more*noEvent(if mode*omega > 0 then exp(-(omega/omega_more)^2) else 1);
  isForward = omega > -omega_never;
  isBackward = omega < -omega_never;
  isPushedForward = M > M_max + M_never;
  isPushedBackward = M < -M_max - M_never;
  when initial() then
    mode = if isForward then 1 elseif isBackward then -1 elseif isPushedForward then 1
      elseif isPushedBackward then -1 else 0;
  elsewhen pre(mode) == 1 and isBackward then
    mode = if isPushedBackward then -1 else 0;
  elsewhen pre(mode) == -1 and isForward then
    mode = if isPushedForward then 1 else 0;
  elsewhen pre(mode) == 0 and isPushedForward then
    mode = 1;
  elsewhen pre(mode) == 0 and isPushedBackward then
    mode = -1;
  end when;
  isStuck = mode == 0;
  M_f = if isStuck then M else mode*M_slide;

  annotation (
    defaultComponentName = "friction",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Line(points = {{20, 50}, {70, 50}}, color = {160, 60, 40}, thickness = 0.5,
        arrow = {Arrow.Filled, Arrow.Filled}, arrowSize = 8)}),
    Documentation(info = "<html>
<p>Dry friction for a shaft whose motion is computed: it decides whether the shaft moves at all. Its state is
<code>mode</code>:</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"3\">
<tr><th>mode</th><th>the shaft</th><th>M_f</th><th>until</th></tr>
<tr><td>1, -1</td><td>slides forward, backward</td><td>mode*M_slide</td><td>omega passes zero</td></tr>
<tr><td>0</td><td>is stuck</td><td>M</td><td>abs(M) exceeds M_max</td></tr>
</table>
<p><code>M</code> is the moment of everything else on the shaft. Where <code>omega</code> passes zero, the shaft
sticks if <code>M_max</code> can hold against <code>M</code>; else it turns back. Each change is a state event. The
model around this one sets <code>omega</code> to zero there with <code>reinit</code>, and holds the acceleration at
zero while <code>isStuck</code>, free of rounding errors: the shaft does not creep. It may come to rest anywhere
within a band.</p>
<p>The friction laws are not regularized at low velocity.</p>
</html>"));
end StickSlip;
