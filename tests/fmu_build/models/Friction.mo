package Friction "Stick and slip with discrete modes"
  model StickSlip "A mass on a moving belt, held by a spring: Coulomb friction with a Boolean mode"
    parameter Real m(unit="kg") = 1 "Mass";
    parameter Real k(unit="N/m") = 1 "Stiffness";
    parameter Real v_belt(unit="m/s") = 0.2 "Speed of the belt";
    parameter Real f_static(unit="N") = 1.0 "Largest friction force while sticking";
    parameter Real f_slip(unit="N") = 0.6 "Friction force while slipping";
    Real x(start=0, fixed=true, unit="m") "Stretch of the spring";
    Real v(start=0.2, fixed=true, unit="m/s") "Velocity of the mass";
    Boolean slipping(start=false, fixed=true) "Mode";
    discrete Integer slips(start=0, fixed=true) "Number of slips so far";
  equation
    der(x) = v;
    m*der(v) = if slipping then f_slip - k*x else 0;
    when {k*x > f_static, pre(slipping) and v > v_belt} then
      slipping = not pre(slipping);
      slips = pre(slips) + (if slipping then 1 else 0);
      reinit(v, v_belt);
    end when;
  end StickSlip;

  model Brake "A sliding body that comes to rest: Integer mode, forward, stuck, backward"
    parameter Real mu_g(unit="m/s2") = 2 "Deceleration by friction";
    parameter Real drive(unit="m/s2") = 3 "Amplitude of the driving acceleration";
    Real v(start=1, fixed=true, unit="m/s");
    Real s(start=0, fixed=true, unit="m");
    Real u(unit="m/s2") "Drive: a ramp";
    Integer mode(start=1, fixed=true) "1 forward, 0 stuck, -1 backward";
  equation
    u = -drive + drive*time;
    der(s) = v;
    der(v) = if mode == 0 then 0 else u - mode*mu_g;
    when v < 0 and pre(mode) == 1 then
      mode = if u < -mu_g then -1 else 0;
      reinit(v, 0);
    elsewhen v > 0 and pre(mode) == -1 then
      mode = if u > mu_g then 1 else 0;
      reinit(v, 0);
    elsewhen pre(mode) == 0 and u > mu_g then
      mode = 1;
    elsewhen pre(mode) == 0 and u < -mu_g then
      mode = -1;
    end when;
  end Brake;

  model Block "A block on a plane, as the friction elements of Modelica's standard library are written"
    parameter Real m(unit="kg") = 1 "Mass";
    parameter Real f_max(unit="N") = 1 "Friction, which is as large while the block sticks";
    parameter Real v_start(unit="m/s") = 2;
    parameter Real ramp(unit="N/s") = 0 "Rate of the driving force";
    parameter Real amplitude(unit="N") = 0 "And an oscillating part of it";
    parameter Real omega(unit="rad/s") = 1;
    Real s(start=0, fixed=true, unit="m");
    Real v(start=v_start, fixed=true, unit="m/s");
    Real a(unit="m/s2");
    Real f(unit="N") "Friction force";
    Real u(unit="N") "Driving force";
    Real sa(unit="N") "Parameter of the path: acceleration or force";
    Boolean startForward(start=false), startBackward(start=false), locked(start=false);
    Integer mode(start=3, min=-1, max=3) "1 forward, 0 stuck, -1 backward, 2 and 3 before the start";
  equation
    u = ramp*time + amplitude*sin(omega*time);
    der(s) = v;
    der(v) = a;
    m*a = u - f;
    startForward = pre(mode) == 0 and (sa > f_max or pre(startForward) and sa > f_max)
      or pre(mode) == -1 and v > 0 or initial() and v > 0;
    startBackward = pre(mode) == 0 and (sa < -f_max or pre(startBackward) and sa < -f_max)
      or pre(mode) == 1 and v < 0 or initial() and v < 0;
    locked = not (mode == 1 or mode == -1 or startForward or startBackward);
    a = if locked then 0 elseif startForward then sa - f_max elseif startBackward then sa + f_max
      elseif pre(mode) == 1 then sa - f_max else sa + f_max;
    f = if locked then sa elseif startForward then f_max elseif startBackward then -f_max
      elseif pre(mode) == 1 then f_max else -f_max;
    mode = if (pre(mode) == 1 or pre(mode) == 2 or startForward) and v > 0 then 1
      elseif (pre(mode) == -1 or pre(mode) == 3 or startBackward) and v < 0 then -1 else 0;
  end Block;
end Friction;
