within PreloadedSprings.Friction;
model Prescribed "Dry friction of a shaft whose motion is prescribed"
  extends Interfaces.DryFriction;
  Interfaces.Signals.TorqueOutput M_band "Largest friction moment to either side at rest, zero while sliding"
    annotation (Placement(transformation(extent = {{100, -60}, {120, -40}})));
equation
  M_stribeck = T_more*exp(-(omega/omega_more)^2);
  // Values at each instant, not between events: samples at rest are at rest exactly, and nothing is integrated.
  M_f = noEvent(if omega > 0 then M_slide elseif omega < 0 then -M_slide else 0);
  M_band = noEvent(if omega > 0 or omega < 0 then 0 else M_max);

  annotation (
    defaultComponentName = "friction",
    Documentation(info = "<html>
<p>Where the motion is prescribed, the sign of <code>omega</code> gives the friction moment <code>M_f</code>. At rest
the motion does not determine it: it may have any value from <code>-M_band</code> to <code>M_band</code>, and
<code>M_f</code> is zero, the middle of that band.</p>
</html>"));
end Prescribed;
