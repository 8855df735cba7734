within PreloadedSprings.Operator;
partial model HeldMechanism "Mechanism that a hand holds and lets go: a held joystick without its damping law"
  extends Joystick.RubbingMechanism;
  Interfaces.Signals.AngleInput theta_ref(start = 0) "Angle to which the hand is drawn"
    annotation (Placement(transformation(extent = {{-220, -110}, {-200, -90}}),
      iconTransformation(extent = {{-120, 70}, {-100, 90}})));
  Interfaces.Signals.AngularVelocityInput omega_ref(start = 0) "Angular velocity of theta_ref"
    annotation (Placement(transformation(extent = {{-220, -150}, {-200, -130}}),
      iconTransformation(extent = {{-120, 40}, {-100, 60}})));
  Interfaces.Signals.RatioInput grip(start = 0, min = 0, max = 1) "1: the hand holds the handle, 0: it has let go"
    annotation (Placement(transformation(extent = {{-220, -190}, {-200, -170}}),
      iconTransformation(extent = {{-120, -60}, {-100, -40}})));
  Interfaces.Signals.TorqueOutput T_hand "Torque of the hand"
    annotation (Placement(transformation(extent = {{200, -220}, {220, -200}}),
      iconTransformation(origin = {0, -108}, extent = {{-8, -8}, {8, 8}}, rotation = -90)));
  HandArm hand "Hand and arm"
    annotation (Placement(transformation(extent = {{-180, -160}, {-140, -120}})));
equation
  hand.theta_ref = theta_ref;
  hand.omega_ref = omega_ref;
  hand.theta = theta;
  hand.omega = omega;
  T_hand = grip*hand.T;

  annotation (
    __pyjoystick(terminals(hand(inflow(tau = "T_hand"), signal(phi = "theta", w = "omega")))),
    Documentation(info = "<html>
<p>What <a href=\"modelica://PreloadedSprings.Operator.HeldJoystick\">HeldJoystick</a> and
<a href=\"modelica://PreloadedSprings.Operator.HeldJoystickPowerLaw\">HeldJoystickPowerLaw</a> have in common. A model
that extends this must set the torque on the shaft, <code>drive.T</code>, to a sum that includes <code>T_hand</code>.
<a href=\"modelica://PreloadedSprings.Operator.HandArm\">Hand and arm</a> act on the shaft beside the torque
<code>T</code>, as far as <code>grip</code> closes: <code>T_hand = grip*(K*(theta_ref - theta) + D*(omega_ref -
omega))</code>. The hand's mass counts only if it is part of <code>J</code>, also after letting go.</p>
</html>"));
end HeldMechanism;
