package Initialization "Initial equations"
  model SteadyState "Starts at rest: der(x) = 0"
    parameter Real u = 3;
    Real x(start=2), y(start=1);
  initial equation
    der(x) = 0;
    der(y) = 0;
  equation
    der(x) = -2*x + y + u;
    der(y) = x - y*y + (if time > 1 then 1 else 0);
  end SteadyState;

  model FoundParameter "A parameter with fixed=false that the initial equations determine"
    parameter Real k(fixed=false, start=1) "Stiffness such that the force is 8 at the start";
    parameter Real x_0 = 2;
    Real x(start=x_0, fixed=true);
    Real v(start=0, fixed=true);
    Real force;
  initial equation
    force = -8;
  equation
    force = -k*x;
    der(x) = v;
    der(v) = force;
  end FoundParameter;

  model FoundFromZero "A parameter that has no effect at the guesses, which are zero"
    parameter Real p(fixed=false) "Rate of decay, from the value and the slope at the start";
    parameter Real slope = -6;
    Real s;
  initial equation
    s = 2;
    der(s) = slope;
  equation
    der(s) = -p*s;
  end FoundFromZero;

  model StartsFromParameters "Start values, dependent parameters and final parameters"
    parameter Real amplitude = 2;
    parameter Real phase = 0.5;
    parameter Real omega = 3;
    final parameter Real stiffness = omega*omega;
    parameter Real energy = 0.5*stiffness*amplitude^2 "May be given; computed by default";
    Real x(start=amplitude*cos(phase), fixed=true);
    Real v(start=-amplitude*omega*sin(phase), fixed=true);
    Real relative "Energy over its start value";
  protected
    Real e "Energy";
  equation
    der(x) = v;
    der(v) = -stiffness*x;
    e = 0.5*(v*v + stiffness*x*x);
    relative = e/energy;
  end StartsFromParameters;

  model Pendulum "The start angle follows from a nonlinear initial equation"
    parameter Real height = 0.5 "Height of the bob at the start, in lengths";
    Real phi(start=1), omega(start=0, fixed=true);
    Real h;
  initial equation
    h = height;
  equation
    h = 1 - cos(phi);
    der(phi) = omega;
    der(omega) = -sin(phi);
  end Pendulum;

  model Guesses "Start values that parameters decide, where they pick one of two solutions"
    parameter Real p = 2;
    parameter Real q[2] = {1, -2};
    parameter Boolean upper = true;
    parameter Real k(fixed=false, start=-p) "Found by an initial equation";
    Real loose(start=3*p) "A state that nothing else determines";
    Real z(start=3*p) "A state in an initial equation";
    Real w(start=if upper then sqrt(abs(p)) else -sqrt(abs(p))) "Algebraic, in an equation of its own";
    Real u[2](start=2*q) "Algebraic arrays";
    Real r[2](start={min(p, 0) - 1, q[2]});
    Real each_one[2](each start=p);
    Real filled[2](start=fill(p, 2));
  initial equation
    z^2 = 9*p^2;
    k^2 = p^2;
  equation
    der(loose) = 1;
    der(z) = 0;
    w^2 = abs(p) + time;
    u[1]^2 = 4 + time;
    u[2]^2 = 9 + time;
    r[1]^2 = 1 + time;
    r[2]^2 = 4 + time;
    each_one[1]^2 = 1 + time;
    each_one[2]^2 = 4 + time;
    filled[1]^2 = 1 + time;
    filled[2]^2 = 4 + time;
  end Guesses;
end Initialization;
