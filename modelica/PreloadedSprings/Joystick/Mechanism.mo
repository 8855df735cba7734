within PreloadedSprings.Joystick;
partial model Mechanism "Handle, cam plate with its actuators, and weight on one shaft"
  parameter PreloadedSprings.Units.MomentOfInertia J = 0.01135 "Mass moment of inertia about the pivot";
  parameter PreloadedSprings.Units.Mass m = 0.87 "Mass of the handle";
  parameter PreloadedSprings.Units.Length h = 0.082 "Distance from the pivot to the center of mass";
  parameter PreloadedSprings.Units.Acceleration g(min = 0) = 9.80665 "Acceleration of gravity";
  parameter PreloadedSprings.Units.Length a = 0.02398 "Distance from the pivot to the plunger axes";
  parameter PreloadedSprings.Units.Length b = 0.005 "Distance from the pivot to the cam surface";
  PreloadedSprings.Springs.ActuatorAssembly forward(
    returnSpring(k_s = 2625, k_h = 427375, F_0 = 52.7808125, x_0 = 0.075e-3),
    balanceSpring(k_s = 2975, k_h = 1022400, F_0 = 11.2464, x_0 = 2.932e-3))
    "Actuator that is pressed at positive angles";
  PreloadedSprings.Springs.ActuatorAssembly backward(
    returnSpring(k_s = 1191, k_h = 657809, F_0 = 55.5848605, x_0 = 0.075e-3),
    balanceSpring(k_s = 2899, k_h = 1107910, F_0 = 9.97119, x_0 = 3.054e-3))
    "Actuator that is pressed at negative angles";
protected
  PreloadedSprings.Joystick.CamPlate camPlate(final a = a, final b = b) "Cam plate under the handle";
  PreloadedSprings.Joystick.Gravity gravity(final m = m, final h = h, final g = g) "Weight of the handle";
  PreloadedSprings.Joystick.DrivingTorque drive "Applied torque";
  PreloadedSprings.Joystick.Handle handle(final J = J) "Inertia";
  PreloadedSprings.Parts.Fixed housing "Housing of the actuators";
equation
  connect(camPlate.flange_forward, forward.flange_a);
  connect(camPlate.flange_backward, backward.flange_a);
  connect(forward.flange_b, housing.flange);
  connect(backward.flange_b, housing.flange);
  connect(drive.flange, camPlate.flange);
  connect(handle.flange, camPlate.flange);
  connect(gravity.flange, camPlate.flange);
end Mechanism;
