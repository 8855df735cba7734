package Homotopy "The operator homotopy()"
  model Chosen "Of three solutions, the simplified expression leads to the one on its side"
    parameter Real side = 2;
    parameter Real given = homotopy(2*side, 100) "A parameter has no use for the simplified expression";
    Real x(start=homotopy(side, 100), fixed=true);
    Real z;
    Real twice;
    Real late "Its simplified expression is undefined after time 1";
  equation
    der(x) = given;
    homotopy(z^3 - (1 + time)^2*z, z - side) = 0;
    twice = homotopy(2*z, 0);
    late = homotopy(time, sqrt(1 - time));
  end Chosen;

  model Nested "The simplified expression has one of its own"
    parameter Real side = 2;
    Real z;
  equation
    homotopy(z^3 - (1 + time)^2*z, homotopy(z + 0.1*z^3, z) - side) = 0;
  end Nested;

  model DeadEnd "The simplified equation has no solution"
    Real z(start=0.5);
  equation
    homotopy(z^3 - (1 + time)^3, 0*z + 1) = 0;
  end DeadEnd;

  model Multivibrator "Amplifier with positive feedback, which jumps from one limit to the other"
    parameter Real gain = 1000;
    parameter Real first = 1 "The limit at which it begins";
    Real v "Output, between -1 and 1";
    Real u "Difference of the inputs";
    Real w(start=0, fixed=true) "Voltage of the capacitor";
  equation
    v = homotopy(if gain*u > 1 then 1 elseif gain*u < -1 then -1 else gain*u, first);
    u = v/2 - w;
    der(w) = v - w;
  end Multivibrator;
end Homotopy;
