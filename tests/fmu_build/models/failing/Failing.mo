package Failing "Models that build, and whose run must end with a message"
  model SingularLoop "Two equations that say the same"
    Real x(start=0, fixed=true);
    Real y, z;
  equation
    der(x) = y;
    y + z = x;
    2*y + 2*z = 2*x;
  end SingularLoop;

  model NearlySingularLoop "The same, but rounding keeps the equations apart"
    Real x(start=0.3, fixed=true);
    Real y, z;
  equation
    der(x) = y;
    0.1*y + 0.3*z = x;
    0.3*y + 0.9*z = 3*x;
  end NearlySingularLoop;

  model NoSolution "From t = 0.5 on the equation has no solution"
    Real x(start=1);
  equation
    x*x + x^4 = 0.5 - time;
  end NoSolution;

  model NotFinite "The logarithm of zero and less from t = 0.5 on, and what follows from it"
    Real x(start=0.5, fixed=true), level, v(start=0, fixed=true), w(start=0, fixed=true);
  equation
    der(x) = -1;
    level = log(x);
    der(v) = level;
    der(w) = 2*level + x;
  end NotFinite;

  model NotFiniteFromTheStart "Divides by zero at once"
    Real x(start=2, fixed=true);
  equation
    der(x) = 1/(x - 2);
  end NotFiniteFromTheStart;

  model ImpossibleStart "No start value satisfies the initial equation"
    Real x(start=1);
  initial equation
    x*x = -1;
  equation
    der(x) = -x;
  end ImpossibleStart;

  model EndlessEvents "From t = 0.5 on two when-clauses set each other off"
    Real x(start=0, fixed=true);
    Boolean a(start=false, fixed=true), b(start=false, fixed=true);
  equation
    der(x) = 1;
    when {x > 0.5, pre(b), not pre(b)} then
      a = not pre(a);
    end when;
    when {pre(a), not pre(a)} then
      b = not pre(b);
    end when;
  end EndlessEvents;

  model Chattering "From t = 0.5 on the state is held at its threshold by ever more events"
    Real x(start=0, fixed=true);
  equation
    der(x) = if x > 0.5 then -1 else 1;
  end Chattering;

  model OutOfBounds "From t = 0.5 on the index is beyond the array"
    parameter Real a[3] = {1, 2, 3};
    Integer k;
    output Real y;
  equation
    k = if time < 0.5 then 2 else 4;
    y = a[k];
  end OutOfBounds;

  model HugeInteger "From t = 0.5 on the integers leave the range of FMI's"
    parameter Integer n = 46341 "Its square is above 2^31 - 1, that of 46340 is below";
    output Integer k;
    output Integer l;
  equation
    k = if time < 0.5 then n else n*n;
    l = -k;
  end HugeInteger;

  model Pole "The derivative becomes infinite at t = 1"
    Real x(start=1, fixed=true);
  equation
    der(x) = x*x;
  end Pole;

  model EitherSide "Two solutions on both sides of a guess at which the equation is not defined"
    Real x(start=1, fixed=true);
    Real z;
  equation
    der(x) = -x;
    z/4 = 1/z;
  end EitherSide;

  model EitherSign "Two solutions on both sides of a guess at which the Jacobian is singular"
    Real x(start=1, fixed=true);
    Real z;
  equation
    der(x) = -x;
    z^2 = 4;
  end EitherSign;

  model NoCapacitance "Where C is 0, nothing determines der(v)"
    parameter Real C = 1;
    Real v(start=1, fixed=true), u(start=2, fixed=true);
    Real i "From v to u";
  equation
    i = C*(der(v) - der(u));
    i + i^3 = -v - 0.1*C*der(v);
    der(u) = i - u;
  end NoCapacitance;

  model TwoStarts "Initial equations with two solutions, and guesses halfway between them"
    parameter Real p(fixed=false), q(fixed=false);
    Real x(start=1, fixed=true);
  initial equation
    p*q = 6;
    p + q = 5;
  equation
    der(x) = -x;
  end TwoStarts;

  model Paradox "Positive only if it is not: on one side it is exactly the bound"
    Real x;
    Boolean b;
  equation
    b = x > 0;
    x = if b then 0 else 1 + time;
  end Paradox;
end Failing;
