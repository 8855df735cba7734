package Oscillators "Smooth models"
  model Harmonic "Linear oscillator"
    parameter Real omega(unit="rad/s") = 2;
    Real x(start=1, fixed=true);
    Real v(start=0, fixed=true);
  equation
    der(x) = v;
    der(v) = -omega^2*x;
  end Harmonic;

  model VanDerPol "Van der Pol's oscillator"
    parameter Real mu = 1;
    Real x(start=2, fixed=true);
    Real y(start=0, fixed=true);
  equation
    der(x) = y;
    der(y) = mu*((1 - x*x)*y) - x;
  end VanDerPol;

  model Driven "Damped oscillator with an input force and outputs that depend on it directly"
    parameter Real m(unit="kg", min=1e-6) = 1;
    parameter Real d(unit="N.s/m") = 0.4;
    parameter Real k(unit="N/m") = 4;
    input Real F(unit="N", start=0);
    output Real x(start=0, fixed=true, unit="m");
    output Real v(start=0, fixed=true, unit="m/s");
    output Real a(unit="m/s2") "Depends directly on F";
    output Real power(unit="W") "Power of the force";
  equation
    der(x) = v;
    der(v) = a;
    m*a = F - d*v - k*x;
    power = F*v;
  end Driven;

  model Stiff "Linear, with rates from 1 to 1000"
    Real x(start=1, fixed=true);
    Real y(start=0, fixed=true);
  equation
    der(x) = -x;
    der(y) = -1000*(y - x);
  end Stiff;

  model Differentiated "The compiler has to differentiate an algebraic variable"
    Real x(start=0, fixed=true);
    Real y;
    Real rate "Rate of y";
  equation
    der(x) = cos(time);
    y = sin(x)*x;
    rate = der(y);
  end Differentiated;

  model SwitchedInput "Events of an input: the sign of u switches the direction"
    input Real u(start=0);
    output Real x(start=0, fixed=true);
    output Real y "u, or its double where positive";
    discrete output Integer changes(start=0, fixed=true);
    Boolean positive;
  equation
    positive = u > 0;
    y = if u > 0 then 2*u else u;
    der(x) = if positive then 1 else -1;
    when change(positive) then
      changes = pre(changes) + 1;
    end when;
  end SwitchedInput;

  model DefaultInput "An input with a value of its own, which holds until another one is set"
    input Real u = 2;
    output Real x(start=1, fixed=true);
  equation
    der(x) = u - x;
  end DefaultInput;

  model DiscreteInputs "Integer and Boolean inputs and outputs"
    input Integer gear(start=1);
    input Boolean reverse(start=false);
    output Real speed(start=0, fixed=true);
    output Integer doubled;
    output Boolean forward;
  equation
    doubled = 2*gear;
    forward = not reverse;
    der(speed) = if reverse then -gear else gear;
  end DiscreteInputs;
end Oscillators;
