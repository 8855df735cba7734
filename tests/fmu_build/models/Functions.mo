package Functions "User functions"
  function square "Inlined: one line"
    input Real u;
    output Real y;
  algorithm
    y := u*u;
    annotation (Inline=true);
  end square;

  function horner "Value and derivative of a polynomial, highest power first: loop, array input, two outputs"
    input Real a[:];
    input Real x;
    output Real value;
    output Real slope;
  algorithm
    value := 0;
    slope := 0;
    for i in 1:size(a, 1) loop
      slope := slope*x + value;
      value := value*x + a[i];
    end for;
  end horner;

  function value "The value alone"
    input Real a[:];
    input Real x;
    output Real y;
  algorithm
    (y,) := horner(a, x);
  end value;

  function interpolate "Piecewise-linear table with straight continuation"
    input Real x[:];
    input Real y[size(x, 1)];
    input Real u;
    output Real v;
  protected
    Integer i;
  algorithm
    i := 1;
    while i < size(x, 1) - 1 and u > x[i + 1] loop
      i := i + 1;
    end while;
    v := y[i] + (u - x[i])*(y[i + 1] - y[i])/(x[i + 1] - x[i]);
  end interpolate;

  function newton_root "Square root by Newton's method: a function that calls another in its loop"
    input Real a;
    output Real r;
  algorithm
    r := if a > 1 then a else 1;
    for i in 1:20 loop
      if abs(square(r) - a) > 1e-14*a then
        r := 0.5*(r + a/r);
      end if;
    end for;
  end newton_root;

  function rotate "Array result"
    input Real v[2];
    input Real angle;
    output Real w[2];
  algorithm
    w := {cos(angle)*v[1] - sin(angle)*v[2], sin(angle)*v[1] + cos(angle)*v[2]};
  end rotate;

  model Inlined "A one-line function"
    Real x(start=0.5, fixed=true);
  equation
    der(x) = square(x) - 1;
  end Inlined;

  model Polynomial "Two outputs of one call"
    parameter Real a[4] = {1, -6, 11, -6} "(x-1)(x-2)(x-3)";
    Real x(start=0, fixed=true);
    Real p, dp;
    Real integral(start=-6, fixed=true) "Integral of dp equals p";
  equation
    der(x) = 1;
    (p, dp) = horner(a, x);
    der(integral) = dp;
  end Polynomial;

  function second "The first argument has no effect"
    input Real u;
    input Real v;
    output Real y;
  algorithm
    y := sin(v);
  end second;

  model Ignored "An expression of an unknown is an argument without an effect, and part of an equation"
    Real w(start=1), y, z;
  equation
    y = second(3*sin(w), time);
    z = 3*sin(w) + 1;
    w^2 = 1 + time;
  end Ignored;

  model Table "Interpolation in a function with a while loop"
    parameter Real x_table[4] = {0, 1, 2, 4};
    parameter Real y_table[4] = {0, 2, 1, 5};
    Real y;
  equation
    y = interpolate(x_table, y_table, 4*time);
  end Table;

  model Newton "Nested calls"
    Real y;
  equation
    y = newton_root(1 + 3*time);
  end Newton;

  model Threshold "A relation on the value of a function makes an event"
    parameter Real a[3] = {1, 1, 1} "x^2 + x + 1";
    Real x(start=0, fixed=true);
    Real y(start=0, fixed=true);
    Boolean above;
  equation
    der(x) = 1;
    above = value(a, x) > 1.75;
    der(y) = if value(a, x) > 3 then 2 elseif above then 1 else 0;
  end Threshold;

  model Rotation "A function with an array result"
    Real x[2](start={1, 0}, each fixed=true);
    Real w[2];
  equation
    w = rotate(x, 0.5);
    der(x) = {-x[2], x[1]};
  end Rotation;

  function given "A signal and its derivative: the one where it is called, the other where that is differentiated"
    input Real u[2];
    input Real at;
    output Real y;
  algorithm
    y := u[1];
    annotation (derivative(noDerivative=u)=given_rate);
  end given;

  function given_rate
    input Real u[2];
    input Real at;
    input Real der_at;
    output Real der_y;
  algorithm
    der_y := u[2];
  end given_rate;

  model Given "The annotation says what the derivative is, here by intention not that of the value"
    Real y;
    Real z;
  equation
    y = given({sin(time), exp(-time)}, time);
    z = der(y);
  end Given;
end Functions;
