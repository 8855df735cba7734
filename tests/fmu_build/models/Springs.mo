package Springs "Chains of restrained preloaded springs, written with if-relations"
  function restrained "Force of one restrained preloaded spring at compression d"
    input Real d(unit="m");
    input Real k_s(unit="N/m");
    input Real k_h(unit="N/m");
    input Real F_0(unit="N");
    output Real f(unit="N");
  algorithm
    f := if d <= 0 then 0 elseif k_h*d <= F_0 then (k_h + k_s)*d else F_0 + k_s*d;
    annotation (Inline=true);
  end restrained;

  model Element "Restrained preloaded spring"
    parameter Real k_s(unit="N/m") = 50;
    parameter Real k_h(unit="N/m") = 2000;
    parameter Real F_0(unit="N") = 5;
    input Real d(unit="m") "Compression";
    Real f(unit="N") "Force";
  equation
    f = if d <= 0 then 0 elseif k_h*d <= F_0 then (k_h + k_s)*d else F_0 + k_s*d;
  end Element;

  model TwoMasses "Wall, spring, mass, springs both ways, mass: each contact has a clearance"
    parameter Real m_1(unit="kg") = 1, m_2(unit="kg") = 0.5;
    parameter Real clearance(unit="m") = 0.01;
    Real x_1(start=0, fixed=true, unit="m"), x_2(start=0, fixed=true, unit="m");
    Real v_1(start=2, fixed=true, unit="m/s"), v_2(start=0, fixed=true, unit="m/s");
    Element left(d=-x_1 - clearance);
    Element middle(d=x_1 - x_2 - clearance, k_s=30, F_0=3);
    Element right(d=x_2 - clearance);
    Real energy(unit="J") "Kinetic energy";
  equation
    der(x_1) = v_1;
    der(x_2) = v_2;
    m_1*der(v_1) = left.f - middle.f;
    m_2*der(v_2) = middle.f - right.f;
    energy = 0.5*m_1*v_1^2 + 0.5*m_2*v_2^2;
  end TwoMasses;

  model ThreeMasses "Three masses between two walls, arrays and loops"
    parameter Integer n = 3;
    parameter Real m[n](each unit="kg") = {1, 0.7, 1.3};
    parameter Real damping(unit="N.s/m") = 0.5;
    Real x[n](each start=0, each fixed=true, each unit="m");
    Real v[n](start={1.5, 0, -1}, each fixed=true, each unit="m/s");
    Element left(d=-x[1]);
    Element between_12(d=x[1] - x[2] - 0.02);
    Element between_23(d=x[2] - x[3] - 0.02);
    Element right(d=x[n]);
  equation
    der(x) = v;
    m[1]*der(v[1]) = left.f - between_12.f - damping*v[1];
    m[2]*der(v[2]) = between_12.f - between_23.f - damping*v[2];
    m[3]*der(v[3]) = between_23.f - right.f - damping*v[3];
  end ThreeMasses;

  model InlineFunction "The same spring as an inline function with relations"
    Real x(start=0, fixed=true, unit="m");
    Real v(start=1, fixed=true, unit="m/s");
  equation
    der(x) = v;
    der(v) = restrained(-x, 50, 2000, 5) - restrained(x - 0.005, 30, 1000, 3);
  end InlineFunction;
end Springs;
