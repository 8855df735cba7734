package Refused "Models without sensitivities, or without some"
  model Kinds "Variables of all kinds"
    parameter Real k = 2;
    parameter Integer n = 3;
    parameter Real twice = 2*k;
    final parameter Real fixed = 4;
    constant Real c = 5;
    parameter Integer size = 2;
    Real a[size];
    input Real u;
    output Real x(start=1, fixed=true);
    Boolean above;
  equation
    der(x) = -k*x + u + n + fixed + c + twice;
    above = x > 1;
    for i in 1:size loop
      a[i] = i*x;
    end for;
  end Kinds;

  model Jump "sign() without an event"
    parameter Real k = 2;
    output Real x(start=1, fixed=true);
  equation
    der(x) = -k*sign(x);
  end Jump;

  model Driven "The input moves the event"
    parameter Real k = 2;
    input Real u;
    output Real x(start=1, fixed=true);
  equation
    der(x) = if x + u > k then -1 else -k;
  end Driven;
end Refused;
