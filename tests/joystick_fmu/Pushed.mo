model Pushed "Joystick that dry friction holds, pushed once after a long rest"
  PreloadedSprings.Joystick.JoystickFriction joystick(friction(T_c = 0.05), theta_start = 0.001) "Joystick at rest";
equation
  joystick.T = 0.2*exp(-((time - 30)/0.02)^2);
end Pushed;
