model SampledElsewhen "A sampler in one branch of a when-clause only"
  Real x(start=0, fixed=true);
  discrete Integer n(start=0, fixed=true);
equation
  der(x) = 1;
  when x > 0.45 then
    n = pre(n) + 100;
  elsewhen sample(0.1, 0.2) then // here
    n = pre(n) + 1;
  end when;
end SampledElsewhen;
