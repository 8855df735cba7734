model EnumerationInitial "The state of a machine, given by an initial equation"
  type Mode = enumeration(idle, running);
  Mode mode;
  Real x(start=0, fixed=true);
initial equation
  pre(mode) = Mode.idle; // here
equation
  der(x) = 1;
  when x > 0.5 then
    mode = Mode.running;
  end when;
end EnumerationInitial;
