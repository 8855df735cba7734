package Constraints "States with linear constraints between them"
  connector Flange
    Real phi(unit="rad");
    flow Real tau(unit="N.m");
  end Flange;

  model Inertia
    parameter Real J(unit="kg.m2") = 1;
    parameter StateSelect stateSelect = StateSelect.default;
    Flange a, b;
    Real phi(unit="rad", stateSelect=stateSelect);
    Real w(unit="rad/s", stateSelect=stateSelect);
  equation
    phi = a.phi;
    phi = b.phi;
    w = der(phi);
    J*der(w) = a.tau + b.tau;
  end Inertia;

  model Gear "Ideal gear"
    parameter Real ratio = 2;
    Flange a, b;
  equation
    a.phi = ratio*b.phi;
    0 = ratio*a.tau + b.tau;
  end Gear;

  model Spring "Spring and damper in parallel, whose relative angle would rather be a state"
    parameter Real c(unit="N.m/rad") = 8;
    parameter Real d(unit="N.m.s/rad") = 0;
    Flange a, b;
    Real phi_rel(unit="rad", stateSelect=StateSelect.prefer);
    Real w_rel(unit="rad/s", stateSelect=StateSelect.prefer);
  equation
    phi_rel = b.phi - a.phi;
    w_rel = der(phi_rel);
    b.tau = c*phi_rel + d*w_rel;
    a.tau = -b.tau;
  end Spring;

  model Wall
    Flange a;
  equation
    a.phi = 0;
  end Wall;

  model Geared "Inertia, gear, inertia, spring, wall"
    parameter Real ratio = 2;
    Inertia fast(J=0.25);
    Inertia slow(J=1, phi(start=0.1, fixed=true), w(start=0, fixed=true));
    Gear gear(ratio=ratio);
    Spring spring;
    Wall wall;
  equation
    connect(fast.b, gear.a);
    connect(gear.b, slow.a);
    connect(slow.b, spring.a);
    connect(spring.b, wall.a);
  end Geared;

  model Selected "The same, with one of the two inertias' states required and the other's refused"
    extends Geared(fast(stateSelect=StateSelect.always), slow(stateSelect=StateSelect.never));
  end Selected;

  model Carried "A mass on another one, which it is moved along by a sine"
    parameter Real m_1(unit="kg") = 2, m_2(unit="kg") = 0.5, k(unit="N/m") = 50;
    parameter Real amplitude(unit="m") = 0.2, omega(unit="rad/s") = 3;
    Real x_1(start=0.1, fixed=true, unit="m"), v_1(start=0, fixed=true, unit="m/s");
    Real x_2(unit="m"), v_2(unit="m/s"), F(unit="N");
  equation
    der(x_1) = v_1;
    der(x_2) = v_2;
    m_1*der(v_1) = -k*x_1 - F;
    m_2*der(v_2) = F;
    x_2 = x_1 + amplitude*sin(omega*time);
  end Carried;

  model Bounced "A body thrown at a floor, and one that it moves along by a sine: the two bounce together"
    Real a(start=0.2, fixed=true), b, v(start=-1, fixed=true), w, F;
  equation
    der(a) = v;
    der(b) = w;
    der(v) = -F;
    der(w) = F;
    b = a + sin(time);
    when a < 0 then
      reinit(v, -pre(v));
    end when;
  end Bounced;

  model Stopped "Two bodies with a damper between them; one is stopped, and the other's speed is a state by choice"
    Real v_1(start=1, fixed=true);
    Real v_2(stateSelect=StateSelect.prefer);
    Real v_rel(start=0.2, fixed=true);
  equation
    v_rel = v_2 - v_1;
    der(v_1) = v_rel;
    der(v_2) = -v_rel;
    when time >= 0.5 then
      reinit(v_1, 0);
    end when;
  end Stopped;
end Constraints;
