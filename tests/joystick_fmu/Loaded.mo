package Loaded "Joysticks with other machine parts on their shaft, whose connector is not the library's"
  connector Flange "The pair of the Modelica Standard Library"
    Real phi(unit = "rad") "Angle";
    flow Real tau(unit = "N.m") "Torque";
  end Flange;

  model Inertia "Rigid body on a shaft, its equations as in the Modelica Standard Library"
    parameter Real J(unit = "kg.m2") = 0.01 "Moment of inertia";
    Flange flange_a "Left side";
    Flange flange_b "Right side";
    Real phi(unit = "rad") "Angle";
    Real w(unit = "rad/s") "Angular velocity";
    Real a(unit = "rad/s2") "Angular acceleration";
  equation
    phi = flange_a.phi;
    phi = flange_b.phi;
    w = der(phi);
    a = der(w);
    J*a = flange_a.tau + flange_b.tau;
  end Inertia;

  model SpringDamper "Elastic shaft"
    parameter Real c(unit = "N.m/rad") = 20 "Stiffness";
    parameter Real d(unit = "N.m.s/rad") = 0.02 "Damping";
    Flange flange_a "Left side";
    Flange flange_b "Right side";
    Real phi_rel(unit = "rad") "Twist";
  equation
    phi_rel = flange_b.phi - flange_a.phi;
    flange_b.tau = c*phi_rel + d*der(phi_rel);
    flange_a.tau + flange_b.tau = 0;
  end SpringDamper;

  model Torque "Torque that swings"
    parameter Real amplitude(unit = "N.m") = 2 "Amplitude";
    Flange flange "Driven shaft";
  equation
    flange.tau = -amplitude*sin(7*time);
  end Torque;

  model Motor "Direct-current motor with its rotor, behind a gear"
    parameter Real R(unit = "Ohm") = 2 "Resistance";
    parameter Real L(unit = "H") = 0.01 "Inductance";
    parameter Real k(unit = "N.m/A") = 0.05 "Torque constant";
    parameter Real ratio(unit = "1") = 5 "Turns of the rotor for one of the flange";
    parameter Real J(unit = "kg.m2") = 1e-4 "Moment of inertia of the rotor";
    Flange flange "Driven shaft";
    Real i(unit = "A", start = 0, fixed = true) "Current";
    Real phi(unit = "rad") "Angle of the rotor";
    Real w(unit = "rad/s") "Angular velocity of the rotor";
  equation
    phi = ratio*flange.phi;
    w = der(phi);
    J*der(w) = k*i + flange.tau/ratio;
    L*der(i) = 12*sin(7*time) - R*i - k*w;
  end Motor;

  model RigidLoad "Joystick with an inertia on its shaft"
    PreloadedSprings.Joystick.Joystick joystick(T = 0, theta_start = -0.3) "Joystick";
    Inertia load "Load";
  equation
    connect(joystick.flange, load.flange_a);
  end RigidLoad;

  model RubbingLoad "Joystick with dry friction and an inertia on its shaft"
    PreloadedSprings.Joystick.JoystickFriction joystick(T = 0, theta_start = -0.3,
      friction(T_c = 0.03, T_s = 0.06, omega_s = 0.2)) "Joystick";
    Inertia load "Load";
  equation
    connect(joystick.flange, load.flange_a);
  end RubbingLoad;

  model Driven "Joystick with dry friction that a torque at its flange moves"
    PreloadedSprings.Joystick.JoystickFriction joystick(T = 0, friction(T_c = 0.3)) "Joystick";
    Torque torque "Drive";
  equation
    connect(joystick.flange, torque.flange);
  end Driven;

  model ElasticLoad "Joystick with an inertia on an elastic shaft"
    PreloadedSprings.Joystick.JoystickPowerLaw joystick(T = 0, theta_start = -0.3) "Joystick";
    SpringDamper shaft "Elastic shaft";
    Inertia load(phi(start = 0.1, fixed = true), w(start = 0, fixed = true)) "Load";
  equation
    connect(joystick.flange, shaft.flange_a);
    connect(shaft.flange_b, load.flange_a);
  end ElasticLoad;

  model Motorized "Joystick that a motor drives through a gear"
    PreloadedSprings.Joystick.Joystick joystick(T = 0) "Joystick";
    Motor motor "Motor";
  equation
    connect(joystick.flange, motor.flange);
  end Motorized;
end Loaded;
