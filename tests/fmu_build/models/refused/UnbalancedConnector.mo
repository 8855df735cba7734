model UnbalancedConnector "A connector with two potentials and one flow"
  connector Port // here
    Real a;
    Real b;
    flow Real f;
  end Port;
  Port p, q;
  Real x(start=0, fixed=true);
equation
  connect(p, q);
  p.a = x;
  p.b = 2;
  der(x) = p.f;
end UnbalancedConnector;
