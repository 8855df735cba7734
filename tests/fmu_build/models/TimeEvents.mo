package TimeEvents "Events at times that are known beforehand"
  model Steps "Several comparisons with time, two of them depending on parameters"
    parameter Real t_1(unit="s") = 0.5;
    parameter Real duration(unit="s") = 0.25;
    Real x(start=0, fixed=true);
    Real y(start=0, fixed=true);
    discrete Real t_when(start=0, fixed=true);
    discrete Integer n(start=0, fixed=true);
  equation
    der(x) = if time < t_1 then 1 elseif time < t_1 + duration then -2 else 3;
    der(y) = if time > t_1 then 1 else 0;
    when time >= 2*t_1 - 0.1 then
      t_when = time;
      n = pre(n) + 1;
    elsewhen time >= 1.5 then
      t_when = time;
      n = pre(n) + 10;
    end when;
  end Steps;

  model SteppedBranches "Steps of expressions whose branches change with time"
    parameter Real t_1(unit="s") = 0.5;
    Real up, down;
    Integer n;
    Real x(start=0, fixed=true);
  equation
    up = ceil(if time <= t_1 then 0.3 else -time - 1);
    down = floor(if time >= 2*t_1 then 4.5 else 1.5);
    n = integer(if time > t_1 then 2.5 else time);
    der(x) = n;
  end SteppedBranches;

  model SelfScheduling "Each event sets the time of the next: 0.1, 0.3, 0.7, 1.5, ..."
    discrete Real t_next(start=0.1, fixed=true, unit="s");
    discrete Integer n(start=0, fixed=true);
    Real x(start=0, fixed=true);
  equation
    der(x) = n;
    when time >= pre(t_next) then
      t_next = 2*pre(t_next) + 0.1;
      n = pre(n) + 1;
    end when;
  end SelfScheduling;

  model Neighbours "The ninth event of a chain comes a rounding error before a whole multiple of the period"
    parameter Real step(unit="s") = 0.05;
    parameter Real period(unit="s") = 0.25;
    discrete Real t_next(start=0.1, fixed=true, unit="s");
    discrete Integer n(start=0, fixed=true);
    Real since(unit="s");
    Real x(start=0, fixed=true);
  equation
    since = time - period*floor(time/period);
    der(x) = n;
    when time >= pre(t_next) then
      t_next = pre(t_next) + step;
      n = pre(n) + 1;
    end when;
  end Neighbours;

  model Ramp "A ramp between two times"
    parameter Real t_start(unit="s") = 0.3;
    parameter Real duration(unit="s", min=0) = 0.4;
    parameter Real height = 2;
    Real y;
    Real z(start=0, fixed=true) "Integral of the ramp";
  equation
    y = if time < t_start then 0 elseif time < t_start + duration then
      height*(time - t_start)/duration else height;
    der(z) = y;
  end Ramp;

  model InitialWhen "when initial() and a discrete start value"
    parameter Real start_value = 3;
    discrete Real held(start=0, fixed=true);
    Real x(start=0, fixed=true);
  equation
    der(x) = held;
    when {initial(), time >= 1} then
      held = if time < 0.5 then start_value else 2*pre(held);
    end when;
  end InitialWhen;

  model Level "A discrete variable that follows a parameter, the one or the other by the time"
    parameter Real low = 1;
    parameter Real high = 3;
    Boolean on;
    discrete Real level;
    Real x(start=0, fixed=true);
  equation
    on = time >= 0.5;
    level = if on then high*high else low;
    der(x) = level;
  end Level;

  model Pulse "A short pulse while everything else is at rest"
    parameter Real t_pulse(unit="s") = 50;
    parameter Real width(unit="s") = 0.05;
    input Real u "Moves the pulse";
    Real f;
    Boolean on;
    Real v(start=0, fixed=true, unit="s") "How long it was on";
  equation
    f = exp(-((time + u - t_pulse)/width)^2);
    on = f > 0.5;
    der(v) = if on then 1 else 0;
  end Pulse;

  model InputPulse "The same, where an input passes the place of the pulse"
    parameter Real width = 0.05;
    input Real u;
    Real f;
    Boolean on;
    Real v(start=0, fixed=true, unit="s");
  equation
    f = exp(-((u - 50)/width)^2);
    on = f > 0.5;
    der(v) = if on then 1 else 0;
  end InputPulse;

  model PulseTrain "Pulses that began long ago: what the time of the start says of them"
    parameter Real period(unit="s") = 0.3;
    parameter Real origin(unit="s") = -1;
    discrete Real since(unit="s") "Start of the present period";
    Integer number "Number of the present period";
    Real y;
    Real v(start=0, fixed=true, unit="s") "How long it was on";
  initial algorithm
    number := integer((time - origin)/period);
    since := origin + number*period;
  equation
    when integer((time - origin)/period) > pre(number) then
      number = pre(number) + 1;
      since = time;
    end when;
    y = if time < since + 0.4*period then 1 else 0;
    der(v) = y;
  end PulseTrain;

  model Sinc "noEvent() keeps it from zero divided by zero: no event, and true at that very instant"
    parameter Real t_begin(unit="s") = 0.1;
    Real x;
    Real y;
    Real z(start=0, fixed=true, unit="s");
  equation
    x = 10*(time - t_begin);
    y = if time < t_begin then 0 else if noEvent(time - t_begin < 1e-15) then 1 else sin(x)/x;
    der(z) = y;
  end Sinc;
end TimeEvents;
