package Algorithms "Functions with algorithms, for comparison with the same algorithms in Python"
  type Gear = enumeration(low, middle, high);

  record Point
    Real x;
    Real y;
  end Point;

  constant Real weights[4] = {0.1, 0.2, 0.3, 0.4};

  function horner "Loop that counts down over an array of any size"
    input Real a[:];
    input Real x;
    output Real y;
  algorithm
    y := 0;
    for i in size(a, 1):-1:1 loop
      y := y*x + a[i];
    end for;
  end horner;

  function interpolate "while loop, index that is known only at run time"
    input Real xs[:];
    input Real ys[size(xs, 1)];
    input Real x;
    output Real y;
  protected
    Integer k = 1;
  algorithm
    while k < size(xs, 1) - 1 and x > xs[k + 1] loop
      k := k + 1;
    end while;
    y := ys[k] + (ys[k + 1] - ys[k])*(x - xs[k])/(xs[k + 1] - xs[k]);
  end interpolate;

  function polar "Two results"
    input Real x;
    input Real y;
    output Real r;
    output Real phi;
  algorithm
    r := sqrt(x*x + y*y);
    phi := atan2(y, x);
  end polar;

  function nested "Calls with several results, with array literals, in an argument"
    input Real x;
    output Real y;
  protected
    Real r;
    Real phi;
  algorithm
    (r, phi) := polar(x, 2*x + 1);
    y := r*horner({1, 2, 3}, phi) + horner({r, x}, horner({x, phi, r}, 0.5));
  end nested;

  function overwritten "A call whose arguments are its results"
    input Real x;
    output Real a;
    output Real b;
  algorithm
    a := x;
    b := 1 - x;
    (a, b) := polar(a, b);
    (b, a) := polar(b, a);
  end overwritten;

  function piecewise "if, elseif, else; Boolean result"
    input Real x;
    output Real y;
    output Boolean inside;
  algorithm
    if x < -1 then
      y := -1;
      inside := false;
    elseif x > 1 then
      y := 1;
      inside := false;
    else
      y := x;
      inside := true;
    end if;
  end piecewise;

  function logic "Boolean expressions and variables"
    input Real x;
    input Boolean b;
    output Boolean c;
    output Real y;
  protected
    Boolean d;
  algorithm
    d := x > 1 and not b or x == 0.5;
    c := if d then b or x < 3 else not b and x <> 2;
    y := if c and d then 1 elseif c then x else -x;
  end logic;

  function divisions "Integer arithmetic"
    input Integer a;
    input Integer b;
    output Integer quotient;
    output Integer modulus;
    output Integer remainder;
    output Real exact;
  algorithm
    quotient := div(a, b);
    modulus := mod(a, b);
    remainder := rem(a, b);
    exact := a/b + (a - b)/7;
  end divisions;

  function rounding "Functions that round"
    input Real x;
    output Real y[6];
  algorithm
    y := {floor(x), ceil(x), integer(x), mod(x, 0.75), rem(x, 0.75), abs(x)*sign(x)};
  end rounding;

  function elementary "Built-in functions"
    input Real x;
    output Real y;
  algorithm
    y := sin(x) + cos(x)*tan(x/4) + exp(-x) + log(x + 2) + log10(x + 3) + sqrt(x + 2) + asin(x/9) + acos(x/9);
    y := y + atan(x) + atan2(x, 2) + sinh(x/2) + cosh(x/2) + tanh(x) + x^3 + 2^x + min(x, 0.5)*max(x, -0.5);
    y := noEvent(if x > 1 then y else -y) + smooth(0, abs(x));
  end elementary;

  function ratios "Loop variables in integer division"
    input Real x;
    output Real y;
  algorithm
    y := x;
    for i in 1:3 loop
      for j in 1:2:5 loop
        y := y + i/j + div(i, j) + mod(j, i) + i^j;
      end for;
    end for;
  end ratios;

  function early_return "return before the end"
    input Real x;
    output Real y;
  algorithm
    y := x*x;
    if x > 1 then
      y := 2*x;
      return;
    end if;
    y := y + 1;
  end early_return;

  function exchange "An if that exchanges two variables"
    input Real x;
    output Real a;
    output Real b;
  protected
    Real c;
  algorithm
    a := x;
    b := 2;
    if x > 1 then
      c := a;
      a := b;
      b := c;
    end if;
  end exchange;

  function rotated "An if that moves three variables in a circle"
    input Real x;
    output Real a;
    output Real b;
    output Real c;
  protected
    Real t;
  algorithm
    a := x;
    b := 2*x;
    c := 3;
    if x > 0 then
      t := a;
      a := b;
      b := c;
      c := t;
    else
      a := b*c;
    end if;
  end rotated;

  function chain "Statements of an if that build on each other"
    input Real x;
    output Real y;
  protected
    Real z;
  algorithm
    y := x;
    z := 0.25;
    if x > 0.5 then
      y := y*y + z;
      z := y + 0.5*y*z;
      y := 0.5*y*z + y;
      z := z*y - x;
    else
      z := y;
      y := z + 1;
    end if;
    y := y - z;
  end chain;

  function applied "Nested loops with statements between them"
    input Real M[2, 3];
    input Real v[3];
    output Real w[2];
    output Real total;
  protected
    Real s;
  algorithm
    total := 0;
    for i in 1:2 loop
      s := 0;
      for j in 1:3 loop
        s := s + M[i, j]*v[j];
      end for;
      w[i] := s;
      total := total + s*i;
    end for;
  end applied;

  function matrices "Products, transposes, elementwise operations, slices"
    input Real v[4];
    output Real y[4];
    output Real s;
  protected
    Real A[4, 4];
    Real B[4, 2];
  algorithm
    A := identity(4) + 2*ones(4, 4) - fill(0.5, 4, 4);
    A[2, :] := v;
    A[:, 3] := 2*v;
    A := A*transpose(A);
    B := A[:, 2:3];
    y := A*v - v .* v ./ {1, 2, 3, 4} + B*{1, -1};
    for i in 1:2 loop
      y[2:3] := y[1:2];
      y[1] := y[1] + i;
    end for;
    s := v*y + sum(B) + min(A) + max(v) + product(v[1:3]);
  end matrices;

  function sorted "Loops whose range depends on an outer loop, exchanges in an array"
    input Real a[5];
    output Real y[5];
  protected
    Real t;
  algorithm
    y := a;
    for i in 1:4 loop
      for j in i + 1:5 loop
        if y[j] < y[i] then
          t := y[i];
          y[i] := y[j];
          y[j] := t;
        end if;
      end for;
    end for;
  end sorted;

  function branches "Assignments to elements in branches"
    input Real x;
    output Real z[3];
  algorithm
    z := {x, 2, 3};
    if x > 1 then
      z[1] := 7;
      z[2] := z[1] + z[3];
      z[3] := z[2]*x;
    elseif x > 0.5 then
      z := {3, 2, x};
    else
      z[3] := x;
    end if;
  end branches;

  function sums "Comprehensions, reductions, constant tables"
    input Real a[5];
    output Real y;
  protected
    constant Real table[4] = {1, 2, 4, 8};
    Real b[5];
  algorithm
    b := {a[i]*i for i in 1:5};
    y := sum(b) + product(a[i] + 1 for i in 1:5) + max(b[2*i] for i in 1:2) + sum(a[6 - i]/i for i in 2:5);
    for i in 1:4 loop
      y := y + table[i]*b[i]*weights[5 - i];
    end for;
  end sums;

  function picked "Elements at places that are known only at run time, of vectors, matrices and literals"
    input Integer k;
    input Real a[3];
    output Real y;
    output Real z;
    output Real b[3];
  protected
    Real M[2, 3];
  algorithm
    M := [a[1], a[2], a[3]; 4, 5, 6];
    y := a[k] + weights[k];
    z := M[k, 2] + M[1, k];
    b := a;
    b[k] := 0;
  end picked;

  function geared "Enumeration"
    input Gear gear;
    input Real x;
    output Real y;
  algorithm
    y := if gear == Gear.low then x elseif gear > Gear.middle then 3*x else 2*x;
  end geared;

  function moved "Records as input and output"
    input Point p;
    input Real d;
    output Point q;
  algorithm
    q.x := p.x + d;
    q.y := p.y;
    for i in 1:3 loop
      q.y := q.y*d;
    end for;
  end moved;

  function named "Names that mean something in C"
    input Real double;
    input Real at[4];
    output Real result;
  protected
    Real sin;
    Real t;
    Real unused = 3;
  algorithm
    sin := cos(double);
    t := sum(at);
    result := sin*t + tan(sin);
  end named;

  function never "A loop without a turn, an input without use"
    input Real x;
    input Real y;
    output Real z;
  algorithm
    z := x;
    for i in 1:0 loop
      z := z + i;
    end for;
  end never;

  model Calls "One call of each"
    input Integer k;
    parameter Real x = 1;
    parameter Boolean b = true;
    parameter Gear gear = Gear.low;
    parameter Point point(x=1, y=2);
    parameter Real a2[2] = {1, 2};
    parameter Real a3[3] = {1, 2, 3};
    parameter Real a4[4] = {1, 2, 3, 4};
    parameter Real a5[5] = {1, 2, 3, 4, 5};
    parameter Real M[2, 3] = {{1, 2, 3}, {4, 5, 6}};
    Real y1, y2, y3, y4, y5, y6, y7, y8, y9, y10, y11, y12, y13;
    Real r, phi, o1, o2, exact, s1, s2, t1, t2, t3, total, s, at_k, of_m;
    Real v2[2], v3[3], u3[3], v4[4], v5[5], v6[6];
    Boolean inside, c;
    Integer quotient, modulus, remainder;
    Point moved_point;
  equation
    y1 = horner(a2, x*time) + horner(a3, x*time);
    y2 = interpolate(a4, {1, 3, 2, 5}, x*time);
    (r, phi) = polar(x*time, x);
    y3 = nested(x*time);
    (o1, o2) = overwritten(x*time);
    (y4, inside) = piecewise(x*time);
    (c, y5) = logic(x*time, b);
    (quotient, modulus, remainder, exact) = divisions(k, 3);
    v6 = rounding(x*time);
    y6 = elementary(x*time);
    y7 = ratios(x*time);
    y8 = early_return(x*time);
    (s1, s2) = exchange(x*time);
    (t1, t2, t3) = rotated(x*time);
    y9 = chain(x*time);
    (v2, total) = applied(M, time*a3);
    (v4, s) = matrices(time*a4);
    v5 = sorted(time*a5);
    v3 = branches(x*time);
    y10 = sums(time*a5);
    (at_k, of_m, u3) = picked(k, time*a3);
    y11 = geared(gear, x*time);
    moved_point = moved(point, x*time);
    y12 = named(x*time, time*a4);
    y13 = never(x*time, x);
  end Calls;
end Algorithms;
