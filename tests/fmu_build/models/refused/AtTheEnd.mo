model AtTheEnd "terminal()"
  Real x(start=0, fixed=true);
  discrete Real last(start=0, fixed=true);
equation
  der(x) = 1;
  when terminal() then // here
    last = x;
  end when;
end AtTheEnd;
