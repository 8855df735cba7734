within PreloadedSpringsMSL.Examples;
model ForceFeedback "Joystick with force feedback: a current-controlled DC motor makes its springs feel stiffer"
  extends Modelica.Icons.Example;
  parameter SI.RotationalSpringConstant c_feedback = 3 "Spring constant that the operator is made to feel";
  parameter SI.ElectricalTorqueConstant k = 0.05 "Torque constant of the motor";
  parameter Real ratio = 8 "Gear ratio";
  Modelica.Blocks.Sources.CombiTimeTable course(
    table = [0, 0, 0; 0.1, 0, 0; 0.3, 1.6, 0; 1, 1.6, 0; 1.05, 0, 0; 1.2, 0, 0; 1.2, 0, 0.04; 2, 0, 0.04],
    extrapolation = Modelica.Blocks.Types.Extrapolation.HoldLastPoint)
    "Torque of the operator's hand and angle of the felt neutral position"
    annotation (Placement(transformation(extent = {{50, 60}, {70, 80}})));
  PreloadedSprings.Joystick.Joystick joystick "Joystick"
    annotation (Placement(transformation(extent = {{100, -20}, {160, 40}})));
  Modelica.Mechanics.Rotational.Components.IdealGear gear(ratio = ratio) "Gear"
    annotation (Placement(transformation(extent = {{60, -24}, {80, -4}})));
  Modelica.Mechanics.Rotational.Components.Inertia rotor(J = 2e-5) "Rotor of the motor"
    annotation (Placement(transformation(extent = {{30, -24}, {50, -4}})));
  Modelica.Electrical.Analog.Basic.RotationalEMF emf(k = k) "Air gap of the motor"
    annotation (Placement(transformation(extent = {{0, -24}, {20, -4}})));
  Modelica.Electrical.Analog.Basic.Resistor resistor(R = 2.5) "Resistance of the winding"
    annotation (Placement(transformation(extent = {{-60, 10}, {-40, 30}})));
  Modelica.Electrical.Analog.Basic.Inductor inductor(L = 1.2e-3, i(start = 0, fixed = true)) "Inductance of the winding"
    annotation (Placement(transformation(extent = {{-30, 10}, {-10, 30}})));
  Modelica.Electrical.Analog.Sources.SignalVoltage amplifier "Amplifier"
    annotation (Placement(transformation(origin = {-80, -14}, extent = {{-10, -10}, {10, 10}}, rotation = 270)));
  Modelica.Electrical.Analog.Sensors.CurrentSensor current "Current of the motor"
    annotation (Placement(transformation(extent = {{-20, -60}, {-40, -40}})));
  Modelica.Electrical.Analog.Basic.Ground ground "Ground"
    annotation (Placement(transformation(extent = {{-90, -80}, {-70, -60}})));
  Modelica.Blocks.Math.Feedback deviation "From the felt neutral position"
    annotation (Placement(transformation(origin = {150, -70}, extent = {{10, -10}, {-10, 10}})));
  Modelica.Blocks.Math.Gain reference(k = c_feedback/(k*ratio)) "Wanted current"
    annotation (Placement(transformation(origin = {110, -70}, extent = {{10, -10}, {-10, 10}})));
  Modelica.Blocks.Math.Feedback error "Control error"
    annotation (Placement(transformation(extent = {{-120, -110}, {-100, -90}})));
  Modelica.Blocks.Continuous.PI controller(k = 3, T = 2e-3, initType = Modelica.Blocks.Types.Init.InitialState)
    "Current controller"
    annotation (Placement(transformation(extent = {{-130, -24}, {-110, -4}})));
equation
  connect(course.y[1], joystick.T)
    annotation (Line(points = {{71, 70}, {90, 70}, {90, 10}, {97, 10}}, color = {0, 0, 127}));
  connect(joystick.flange, gear.flange_b)
    annotation (Line(points = {{100, -14}, {80, -14}}));
  connect(gear.flange_a, rotor.flange_b)
    annotation (Line(points = {{60, -14}, {50, -14}}));
  connect(rotor.flange_a, emf.flange)
    annotation (Line(points = {{30, -14}, {20, -14}}));
  connect(amplifier.p, resistor.p)
    annotation (Line(points = {{-80, -4}, {-80, 20}, {-60, 20}}, color = {0, 0, 255}));
  connect(resistor.n, inductor.p)
    annotation (Line(points = {{-40, 20}, {-30, 20}}, color = {0, 0, 255}));
  connect(inductor.n, emf.p)
    annotation (Line(points = {{-10, 20}, {10, 20}, {10, -4}}, color = {0, 0, 255}));
  connect(emf.n, current.p)
    annotation (Line(points = {{10, -24}, {10, -50}, {-20, -50}}, color = {0, 0, 255}));
  connect(current.n, amplifier.n)
    annotation (Line(points = {{-40, -50}, {-80, -50}, {-80, -24}}, color = {0, 0, 255}));
  connect(ground.p, amplifier.n)
    annotation (Line(points = {{-80, -60}, {-80, -24}}, color = {0, 0, 255}));
  connect(course.y[2], deviation.u1)
    annotation (Line(points = {{71, 70}, {190, 70}, {190, -70}, {158, -70}}, color = {0, 0, 127}));
  connect(joystick.theta, deviation.u2)
    annotation (Line(points = {{163, 37}, {180, 37}, {180, -90}, {150, -90}, {150, -78}}, color = {0, 0, 127}));
  connect(deviation.y, reference.u)
    annotation (Line(points = {{141, -70}, {122, -70}}, color = {0, 0, 127}));
  connect(reference.y, error.u1)
    annotation (Line(points = {{99, -70}, {20, -70}, {20, -120}, {-140, -120}, {-140, -100}, {-118, -100}},
      color = {0, 0, 127}));
  connect(current.i, error.u2)
    annotation (Line(points = {{-30, -61}, {-30, -114}, {-110, -114}, {-110, -108}}, color = {0, 0, 127}));
  connect(error.y, controller.u)
    annotation (Line(points = {{-101, -100}, {-94, -100}, {-94, -84}, {-150, -84}, {-150, -14}, {-132, -14}},
      color = {0, 0, 127}));
  connect(controller.y, amplifier.v)
    annotation (Line(points = {{-109, -14}, {-92, -14}}, color = {0, 0, 127}));

  annotation (
    Diagram(coordinateSystem(extent = {{-180, -140}, {200, 100}})),
    experiment(StartTime = 0, StopTime = 2, Tolerance = 1e-8, Interval = 1e-3),
    Documentation(info = "<html>
<p>
A table gives the torque of a hand, which pushes the joystick forward and lets go, and the angle
<code>course.y[2]</code> of the neutral position that the motor simulates, which jumps at 1.2 s. The motor adds the
torque <code>c_feedback*(course.y[2] - theta)</code>: the wanted current follows from the angle, and a PI controller
sets the voltage of the winding. Gear and rotor add <code>ratio^2*rotor.J</code> to the moment of inertia of the
handle.
</p>
<p>
Plot <code>joystick.theta</code> with <code>joystick.T</code>, and the current <code>current.i</code> with
<code>reference.y</code>. With <code>c_feedback = 0</code> the motor only loads the joystick.
</p>
</html>"));
end ForceFeedback;
