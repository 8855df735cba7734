model Off "The joystick with a mistake: the damping moment is too large by 1 part in 1e5"
  model Law
    extends PreloadedSprings.Interfaces.DampingLaw;
    parameter PreloadedSprings.Units.RotationalDamping C = 0.045;
  equation
    coefficient = 1.00001*C;
  end Law;
  extends PreloadedSprings.Joystick.Joystick(redeclare Law damping);
end Off;
