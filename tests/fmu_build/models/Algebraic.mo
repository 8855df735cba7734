package Algebraic "Algebraic loops, tearing, and models without states"
  model LinearLoop "Three linear equations that have to be solved together"
    parameter Real a = 2;
    Real x(start=1, fixed=true);
    Real u, v, w;
  equation
    der(x) = -u;
    2*u + v - w = a*x;
    u - 3*v + w = x;
    u + v + 4*w = 1 + x;
  end LinearLoop;

  model NonlinearLoop "Three nonlinear equations in three unknowns"
    Real x(start=0, fixed=true);
    Real u(start=1), v(start=1), w(start=1);
  equation
    der(x) = 1;
    u + v*v = 2 + x;
    v + w*w*w = 2 + x;
    w + exp(u - 1) = 2 + x;
  end NonlinearLoop;

  model TinyLoop "An unknown far below 1, which its nominal value says"
    Real x(start=1, fixed=true);
    Real z;
  protected
    Real q(start=0, nominal=1e-15);
  equation
    der(x) = -x;
    1e15*q + (1e15*q)^3 = 2*x;
    z = 1e15*q;
  end TinyLoop;

  model SharedPart "A variable is part of what a parameter is computed from"
    parameter Real p = 1.06;
    parameter Real q = p*sin(p*sin(p));
    Real u, z;
  equation
    u = sin(p);
    z = q*time + u;
  end SharedPart;

  model Kepler "A nonlinear equation in one unknown at every instant"
    parameter Real eccentricity(min=0, max=0.999) = 0.5;
    Real mean "Mean anomaly";
    Real E(start=0) "Eccentric anomaly";
    Real r "Distance";
  equation
    mean = time;
    mean = E - eccentricity*sin(E);
    r = 1 - eccentricity*cos(E);
  end Kepler;

  model NoStates "Algebra from inputs to outputs"
    input Real u(start=1);
    input Real w(start=2);
    parameter Real gain = 3;
    output Real sum;
    output Real product;
    output Real root;
  equation
    sum = u + gain*w;
    product = u*w;
    root = sqrt(u*u + w*w);
  end NoStates;

  model DiodeBridge "A linear loop whose coefficients switch with an if-relation on the loop's unknown"
    parameter Real R(unit="Ohm") = 2;
    parameter Real g_off(unit="S") = 1e-3 "Conductance of the diode when it blocks";
    parameter Real g_on(unit="S") = 10;
    Real u(unit="V") "Source";
    Real v(unit="V") "Voltage over the diode";
    Real i(unit="A");
    Real q(start=0, fixed=true) "Charge";
  equation
    u = sin(time);
    u = R*i + v;
    i = if v > 0 then g_on*v else g_off*v;
    der(q) = i;
  end DiodeBridge;

  model Aliases "a = b and a = -b with start values on the aliases"
    Real x(start=2, fixed=true);
    Real same;
    Real opposite;
    Real twice_opposite;
    Real v;
  equation
    same = x;
    opposite = -same;
    twice_opposite = -opposite;
    v = der(same);
    v = opposite + 0*twice_opposite;
  end Aliases;

  model Kinks "min, max, abs and sign in equations"
    Real u;
    Real lowest, highest, absolute, direction;
    Real z(start=0, fixed=true) "Integral of |sin|";
  equation
    u = sin(2*time);
    lowest = min(u, 0.25);
    highest = max(u, -0.25);
    absolute = abs(u);
    direction = sign(u);
    der(z) = absolute;
  end Kinks;

  model WarmResistor "A resistance that rises with the temperature; at the start no current flows"
    parameter Real R_0(unit="Ohm") = 10;
    parameter Real slope(unit="1/K") = 0.5;
    parameter Real G(unit="W/K") = 0.5;
    Real v(unit="V"), i(unit="A"), R(unit="Ohm"), Q(unit="W");
    Real T(unit="K", start=300);
  equation
    v = 10*sin(time);
    v = R*i;
    R = R_0*(1 + slope*(T - 300));
    Q = v*i;
    Q = G*(T - 300);
  end WarmResistor;

  function hardening "A spring, and what it holds"
    input Real x;
    input Real k;
    output Real force;
    output Real energy;
  algorithm
    force := x + k*x^3;
    energy := x^2/2 + k*x^4/4;
  end hardening;

  model LoopThroughFunction "The unknown of a loop is an argument of a function"
    parameter Real k = 2;
    Real x(start=0, fixed=true);
    Real stretch, force, energy;
  equation
    der(x) = 1;
    (force, energy) = hardening(stretch, k);
    force = x - stretch;
  end LoopThroughFunction;

  model UndefinedAtZero "Loops that are not defined, or have no finite slope, where their unknowns are zero"
    Real x(start=0, fixed=true);
    Real plus, minus, current, z;
    Real a, b, c, d;
  equation
    der(x) = 1;
    plus = 10 - 0.5*current;
    minus = -10 - 0.5*current;
    current = (20 + x)/(plus - minus) - plus/10;
    sqrt(z) + z = 2 + x;
    1/(a - b) = 2;
    a + b = 3 + x;
    (c - d)^3 = 1;
    c + d = 3 + x;
  end UndefinedAtZero;
end Algebraic;
