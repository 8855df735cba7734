package Moving "Models whose derivatives by parameters are known in closed form"
  model Ball "A bouncing ball; the floor is a parameter of the guard"
    parameter Real start = 1.3 "Height at the start";
    parameter Real g = 9.81;
    parameter Real e = 0.8 "Part of the speed that a bounce leaves";
    parameter Real floor = 0.2 "Height of the floor";
    output Real h(start=start, fixed=true, nominal=1);
    output Real v(start=0, fixed=true);
    output Real energy = v^2/2 + g*h;
    discrete output Real t_bounce(start=0, fixed=true) "Time of the latest bounce";
    discrete output Real best(start=start, fixed=true) "Height that the next bounce reaches";
  equation
    der(h) = v;
    der(v) = -g;
    when h < floor then
      reinit(v, -e*pre(v));
      t_bounce = time;
      best = floor + (e*v)^2/(2*g);
    end when;
  end Ball;

  model Switch "The slope changes at a time that is a parameter, and a value is held there"
    parameter Real T = 0.5 "Half the time of the change";
    parameter Real a = 2;
    parameter Real b = -0.7;
    parameter Real twice = 2*T;
    output Real x(start=0, fixed=true);
    discrete output Real held(start=a, fixed=true);
  equation
    der(x) = if time < twice then a*time else b;
    when time >= twice then
      held = x + b;
    end when;
  end Switch;

  model Relay "A heater that remembers its state with pre()"
    parameter Real low = 0.4 "Switch on below";
    parameter Real high = 0.6 "Switch off above";
    parameter Real rate = 3;
    output Real x(start=low, fixed=true);
    Boolean on(start=true, fixed=true);
  equation
    on = x < low or pre(on) and x <= high;
    der(x) = rate*((if on then 1 else 0) - x);
  end Relay;

  model Block "Dry friction: it slides to rest and stays"
    parameter Real speed = 2;
    parameter Real mu = 0.3;
    output Real x(start=0, fixed=true);
    output Real v(start=speed, fixed=true);
    Boolean stuck(start=false, fixed=true);
  equation
    der(x) = v;
    der(v) = if stuck then 0 else -9.81*mu;
    when v < 0 then
      stuck = true;
      reinit(v, 0);
    end when;
  end Block;

  model Steady "It starts where it would stay without its input, and a parameter follows from that"
    parameter Real k = 2;
    parameter Real u = 0.5;
    parameter Real y_0(fixed=false);
    output Real x(start=1);
    output Real rest;
  initial equation
    x + k*x^3 = u;
    y_0 = k*x;
  equation
    der(x) = -k*x + y_0*exp(-time);
    rest = y_0 - x;
  end Steady;

  model Loop "The rate solves y + y^3 = k*x"
    parameter Real k = 2;
    output Real x(start=1.5, fixed=true);
    output Real y(start=1);
  equation
    y + y^3 = k*x;
    der(x) = -y;
  end Loop;

  function rate
    input Real x;
    input Real k;
    output Real r;
  algorithm
    r := 1;
    for i in 1:2 loop
      r := r*x;
    end for;
    r := -k*r;
  end rate;

  model Called "A Modelica function with a loop"
    parameter Real k = 0.9;
    parameter Real start = 2;
    output Real x(start=start, fixed=true);
  equation
    der(x) = rate(x, k);
  end Called;

  model Sampled "A controller that acts every 0.1 s"
    parameter Real k = 4;
    output Real x(start=1, fixed=true);
    discrete output Real u(start=0, fixed=true);
  equation
    der(x) = u - x;
    when sample(0, 0.1) then
      u = -k*pre(x);
    end when;
  end Sampled;

  model Twins "Two slopes that change where the same line reaches a level"
    parameter Real first = 0.5;
    parameter Real second = 0.5;
    Real x(start=0, fixed=true);
    output Real a(start=0, fixed=true);
    output Real b(start=0, fixed=true);
    output Real c(start=0, fixed=true);
  equation
    der(x) = 2;
    der(a) = if x > first then 3 else 0;
    der(b) = if x > second then 5 else 0;
    der(c) = if 3*x >= 3*first then 7 else 0;
  end Twins;
end Moving;
