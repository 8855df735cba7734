model StartFromTime "An initial value that depends on the time at which the run starts"
  parameter Real period = 0.3;
  Real next;
  Integer count;
initial algorithm
  count := integer(time/period);
  next := count*period;
equation
  when time >= pre(next) + period then
    next = pre(next) + period;
    count = pre(count) + 1;
  end when;
end StartFromTime;
