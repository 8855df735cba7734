model LateStart "The start value of a discrete variable depends on what initial equations determine"
  parameter Real p(fixed = false);
  discrete Real v(start = p, fixed = true);
initial equation
  p = 3;
equation
  when time > 0.7 then
    v = pre(v) + 2;
  end when;
end LateStart;
