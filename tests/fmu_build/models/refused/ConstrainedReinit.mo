model ConstrainedReinit "An event sets a speed that follows from that of another body"
  Real a(start=0.2, fixed=true), b, v(start=-1, fixed=true), w, F;
equation
  der(a) = v;
  der(b) = w;
  der(v) = -F;
  der(w) = F;
  b = a + sin(time);
  when a < 0 then
    reinit(w, -pre(w));
  end when;
end ConstrainedReinit;
