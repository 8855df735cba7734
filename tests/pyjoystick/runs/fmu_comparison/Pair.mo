package Pair "Models with nearly the same interface, to be compared with each other"
  model First "A decay, and what follows an input at once"
    parameter Real k(unit="1/s", min=0) = 2 "Rate of the decay";
    parameter Integer n(min=1, max=9) = 3 "Step of the count";
    parameter Boolean inverted = false;
    parameter Real own = 1 "Parameter of this model alone";
    input Real u(unit="N", start=0.5);
    output Real x(unit="m", start=1, fixed=true);
    output Real y(unit="N");
    output Real integral(unit="N.s", start=0, fixed=true) "Of the input";
    output Integer count;
    output Boolean above;
    Real inside;
  equation
    der(x) = -k*x;
    der(integral) = u;
    y = 2*u;
    count = if time < 0.8 then 0 else n;
    above = if inverted then not (u > 1) else u > 1;
    inside = own*x;
    annotation (experiment(StartTime=0, StopTime=2, Interval=0.004));
  end First;

  model Second "The same until t = 0.5; from there on it decays faster"
    parameter Real k(unit="Hz", min=0.5, max=4) = 2;
    parameter Integer n(min=1, max=9) = 4;
    parameter Boolean inverted = true;
    input Real u(unit="N", start=0.5);
    output Real x(unit="m", start=1, fixed=true);
    output Real y(unit="N");
    output Real integral(unit="N.s", start=0, fixed=true);
    output Integer count;
    output Boolean above;
    output Real z "Output of this model alone";
    Real fast, slow;
  equation
    slow = -k*x;
    fast = -1.01*k*x;
    der(x) = if time < 0.5 then slow else fast;
    der(integral) = u;
    y = 2*u;
    count = if time < 0.8 then 0 else n;
    above = if inverted then not (u > 1) else u > 1;
    z = x;
  end Second;

  model Stops "The same as the first, but it gives up where x falls below 0.7"
    extends First;
  equation
    assert(x > 0.7, "x is too small");
  end Stops;

  model Closed "No input and no output"
    Real a(start=1, fixed=true);
    Real b;
  equation
    der(a) = -a;
    b = 2*a;
  end Closed;
end Pair;
