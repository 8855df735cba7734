package Components "Connectors, inheritance, replaceable parts, conditional parts, records, inner and outer"
  connector Flange "Translational"
    Real s(unit="m");
    flow Real f(unit="N");
  end Flange;

  connector Pin "Electrical"
    Real v(unit="V");
    flow Real i(unit="A");
  end Pin;

  partial model TwoPin "Two pins"
    Pin p, n;
    Real u(unit="V");
    Real i(unit="A");
  equation
    u = p.v - n.v;
    i = p.i;
    p.i + n.i = 0;
  end TwoPin;

  model Resistor
    extends TwoPin;
    parameter Real R(unit="Ohm") = 1;
  equation
    u = R*i;
  end Resistor;

  model Capacitor
    extends TwoPin(u(start=0, fixed=true));
    parameter Real C(unit="F") = 1;
  equation
    C*der(u) = i;
  end Capacitor;

  model Inductor
    extends TwoPin(i(start=0, fixed=true));
    parameter Real L(unit="H") = 1;
  equation
    L*der(i) = u;
  end Inductor;

  model Source
    extends TwoPin;
    parameter Real V(unit="V") = 1;
  equation
    u = V;
  end Source;

  model Ground
    Pin p;
  equation
    p.v = 0;
  end Ground;

  model Circuit "Source, resistor, inductor and capacitor in series"
    Source source(V=2);
    Resistor resistor(R=0.5);
    Inductor inductor(L=1);
    Capacitor capacitor(C=0.25);
    Ground ground;
  equation
    connect(source.p, resistor.p);
    connect(resistor.n, inductor.p);
    connect(inductor.n, capacitor.p);
    connect(capacitor.n, source.n);
    connect(source.n, ground.p);
  end Circuit;

  model Bridge "A Wheatstone bridge: a linear system of the network's unknowns, and one capacitor"
    Source source(V=3);
    Resistor r[4](R={1, 2, 3, 4});
    Resistor load(R=0.5);
    Capacitor capacitor(C=0.2);
    Ground ground;
  equation
    connect(source.p, r[1].p);
    connect(source.p, r[2].p);
    connect(r[1].n, r[3].p);
    connect(r[2].n, r[4].p);
    connect(r[3].n, source.n);
    connect(r[4].n, source.n);
    connect(r[1].n, load.p);
    connect(load.n, capacitor.p);
    connect(capacitor.n, r[2].n);
    connect(source.n, ground.p);
  end Bridge;

  model Body "Sliding mass"
    parameter Real m(unit="kg") = 1;
    parameter Real s_start = 0;
    parameter Real v_start = 0;
    Flange flange;
    Real v(start=v_start, fixed=true, unit="m/s");
    Real s(start=s_start, fixed=true, unit="m");
  equation
    s = flange.s;
    der(s) = v;
    m*der(v) = flange.f;
  end Body;

  partial model Compliant "Force between two flanges"
    Flange flange_a, flange_b;
    Real stretch(unit="m");
    Real f(unit="N");
  equation
    stretch = flange_b.s - flange_a.s;
    flange_b.f = f;
    flange_a.f = -f;
  end Compliant;

  model Spring
    extends Compliant;
    parameter Real k(unit="N/m") = 1;
  equation
    f = k*stretch;
  end Spring;

  model HardeningSpring
    extends Compliant;
    parameter Real k(unit="N/m") = 1;
    parameter Real k_3(unit="N/m3") = 1;
  equation
    f = k*stretch + k_3*stretch^3;
  end HardeningSpring;

  model StiffeningSpring = HardeningSpring(k_3=4) "A short class with a modifier";

  model Fixed
    Flange flange;
  equation
    flange.s = 0;
  end Fixed;

  model Chain "n masses and n springs, connected in a loop"
    parameter Integer n = 5;
    Fixed wall;
    Spring spring[n](each k=10);
    Body body[n](each m=1, v_start={if i == n then 1 else 0 for i in 1:n});
  equation
    connect(wall.flange, spring[1].flange_a);
    for i in 1:n loop
      connect(spring[i].flange_b, body[i].flange);
    end for;
    for i in 1:n - 1 loop
      connect(body[i].flange, spring[i + 1].flange_a);
    end for;
  end Chain;

  model Hidden "Protected components with states, and a protected state of its own"
    output Real seen;
    output Real own;
  protected
    Fixed wall;
    Spring spring(k=4);
    Body body(v_start=2);
    Real x(start=1, fixed=true);
  equation
    connect(wall.flange, spring.flange_a);
    connect(spring.flange_b, body.flange);
    der(x) = -x;
    seen = body.s;
    own = x;
  end Hidden;

  model Replaceable "One body on a wall by a spring of any kind"
    replaceable model Element = Spring constrainedby Compliant;
    Fixed wall;
    Element element;
    Body body(s_start=1);
  equation
    connect(wall.flange, element.flange_a);
    connect(element.flange_b, body.flange);
  end Replaceable;

  model Redeclared "Replaceable with another spring and a modified parameter"
    extends Replaceable(redeclare model Element = StiffeningSpring, body(m=2));
  end Redeclared;

  model ReplaceableComponent "The same with a replaceable component"
    replaceable Spring element constrainedby Compliant;
    Fixed wall;
    Body body(s_start=1);
  equation
    connect(wall.flange, element.flange_a);
    connect(element.flange_b, body.flange);
  end ReplaceableComponent;

  model RedeclaredComponent "Redeclared with modifiers"
    ReplaceableComponent part(redeclare HardeningSpring element(k_3=4), body(m=2));
  end RedeclaredComponent;

  model Conditional "A second spring that is there only if asked for"
    parameter Boolean stiffened = true;
    parameter Boolean braced = false;
    Fixed wall;
    Spring main(k=4);
    Spring extra(k=5) if stiffened;
    Spring brace(k=100) if braced;
    Body body(s_start=1);
  equation
    connect(wall.flange, main.flange_a);
    connect(main.flange_b, body.flange);
    connect(wall.flange, extra.flange_a);
    connect(extra.flange_b, body.flange);
    connect(wall.flange, brace.flange_a);
    connect(brace.flange_b, body.flange);
  end Conditional;

  record Material
    parameter Real density = 2;
    parameter Real volume = 3;
  end Material;

  model World
    parameter Real g(unit="m/s2") = 9.81;
  end World;

  model FallingBody "Gravity from an outer world, mass from a record"
    outer World world;
    parameter Material material;
    parameter Real mass(unit="kg") = material.density*material.volume;
    Real h(start=10, fixed=true), v(start=0, fixed=true);
    Real weight(unit="N");
  equation
    weight = mass*world.g;
    der(h) = v;
    mass*der(v) = -weight;
  end FallingBody;

  model Falling "inner world, one body with a modified record"
    inner World world(g=5);
    FallingBody light;
    FallingBody heavy(material(density=4), h(start=20));
  end Falling;

  type Gear = enumeration(reverse "Backwards", neutral "No drive", forward "Forwards");

  model GearBox "Enumeration parameter and variable, Integer and Boolean parameters"
    parameter Gear selected = Gear.forward;
    parameter Integer ratio = 3;
    parameter Boolean braked = false;
    Gear gear;
    Real x(start=0, fixed=true);
  equation
    gear = if braked or time < 1 then Gear.neutral else selected;
    der(x) = if gear == Gear.forward then ratio elseif gear == Gear.reverse then -1 else 0;
  end GearBox;

  model Carried "Takes its gravity from an outer parameter"
    outer parameter Real gravity;
    Real v(start=0, fixed=true);
  equation
    der(v) = -gravity;
  end Carried;

  model OuterParameter "An inner parameter for two outer ones"
    inner parameter Real gravity = 3;
    Carried first;
    Carried second(v(start=1));
  end OuterParameter;

  connector RotationalFlange
    Real phi(unit="rad");
    flow Real tau(unit="N.m");
  end RotationalFlange;

  model Inertia "Rotating mass whose speed is the derivative of the flange's angle"
    parameter Real J(unit="kg.m2") = 1;
    parameter Real phi_start = 0;
    RotationalFlange flange;
    Real phi(start=phi_start, fixed=true, unit="rad");
    Real w(start=0, fixed=true, unit="rad/s");
  equation
    phi = flange.phi;
    w = der(phi);
    J*der(w) = flange.tau;
  end Inertia;

  model TorsionDamper "Spring and damper between two flanges; takes der() of the flange angles"
    parameter Real c(unit="N.m/rad") = 2;
    parameter Real d(unit="N.m.s/rad") = 0.1;
    RotationalFlange flange_a, flange_b;
    Real twist(unit="rad");
    Real tau(unit="N.m");
  equation
    twist = flange_b.phi - flange_a.phi;
    tau = c*twist + d*der(twist);
    flange_b.tau = tau;
    flange_a.tau = -tau;
  end TorsionDamper;

  model Torsion "Two inertias and a spring-damper"
    Inertia first(J=1, phi_start=1);
    Inertia second(J=2);
    TorsionDamper shaft;
  equation
    connect(first.flange, shaft.flange_a);
    connect(shaft.flange_b, second.flange);
  end Torsion;

  type Pace = enumeration(slow, fast, none);

  model Paced "A rate by the literal of an enumeration"
    parameter Pace pace = Pace.none;
    Real y(start=0, fixed=true);
  equation
    der(y) = if pace == Pace.slow then 1 elseif pace == Pace.fast then 2 else 0;
  end Paced;

  model Opposites "Two parts that do not do the same, as blocks choose the initialization of their parts"
    parameter Pace pace = Pace.fast;
    Paced one(pace=pace);
    Paced other(final pace=if pace == Pace.fast then Pace.slow else Pace.fast);
  end Opposites;

  model Rate "A constant rate of change"
    parameter Real rate = 1;
    parameter Real gain[2] = {1, 1};
    parameter Real twice = 2*rate;
    Real y(start=0, fixed=true);
  equation
    der(y) = gain[1]*rate + gain[2]*twice;
  end Rate;

  model Rates "Hands its values down: open, final, calculated, as an array and through an array of components"
    parameter Real r = 3;
    parameter Real g[2] = {1, 1};
    parameter Integer n = 1;
    parameter Boolean is_on = true;
    Rate open(rate=r);
    Rate closed(final rate=r, final gain=g);
    Rate half(rate=r/2, gain={1, n});
    Rate many[2](each rate=r, gain={{r, 0}, g});
    Rate switched(rate=if is_on then r else 0);
  end Rates;

  model HandedDown "Literals in modifiers of components that hand them down"
    Rates first(r=0.5, g={2, 0.25}, n=2, is_on=true);
    Rates second(open(gain={3, 0}), closed(twice=0.1), r=0.25);
  end HandedDown;
end Components;
