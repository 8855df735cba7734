package StateEvents "Models whose events are found by zero crossings of continuous variables"
  model BouncingBall "A ball that loses a part of its speed at every bounce"
    parameter Real e(min=0, max=1) = 0.7 "Coefficient of restitution";
    parameter Real g(unit="m/s2") = 9.81 "Gravity";
    Real h(start=1, fixed=true, unit="m") "Height";
    Real v(start=0, fixed=true, unit="m/s") "Velocity";
    discrete Integer bounces(start=0, fixed=true) "Number of bounces";
    discrete Real t_bounce(start=0, fixed=true, unit="s") "Time of the latest bounce";
  equation
    der(h) = v;
    der(v) = -g;
    when h < 0 then
      reinit(v, -e*pre(v));
      bounces = pre(bounces) + 1;
      t_bounce = time;
    end when;
  end BouncingBall;

  model PlanarBounce "Two states are reinitialised at the same event"
    parameter Real e = 0.8 "Restitution normal to the floor";
    parameter Real mu = 0.5 "Part of the tangential velocity that is kept";
    Real x(start=0, fixed=true) "Horizontal position";
    Real y(start=2, fixed=true) "Height";
    Real vx(start=3, fixed=true) "Horizontal velocity";
    Real vy(start=0, fixed=true) "Vertical velocity";
  equation
    der(x) = vx;
    der(y) = vy;
    der(vx) = 0;
    der(vy) = -10;
    when y < 0 then
      reinit(vx, mu*pre(vx));
      reinit(vy, -e*pre(vy));
    end when;
  end PlanarBounce;

  model Relay "Hysteresis: a thermostat that remembers its state with pre()"
    parameter Real low = 0.4 "Switch on below";
    parameter Real high = 0.6 "Switch off above";
    parameter Real gain = 1 "Level that the heater drives towards";
    Real x(start=0, fixed=true) "Temperature";
    Boolean on(start=true, fixed=true) "Heater";
    discrete Integer switches(start=0, fixed=true) "Number of changes of the heater";
  equation
    on = x < low or pre(on) and x <= high;
    der(x) = (if on then gain else 0) - x;
    when change(on) then
      switches = pre(switches) + 1;
    end when;
  end Relay;

  model Limiter "A sine cut off by if-relations; its integral is known in closed form"
    parameter Real level = 0.5 "Limit";
    Real u "Sine";
    Real y "Limited sine";
    Real z(start=0, fixed=true) "Integral of y";
  equation
    u = sin(time);
    y = if u > level then level elseif u < -level then -level else u;
    der(z) = y;
  end Limiter;

  model Grazing "A sine that touches a level from below without crossing it, and one that does cross"
    parameter Real level = 0.995;
    Real x(start=0, fixed=true);
    Real v(start=1, fixed=true);
    Boolean above_one "x > 1.0001: never";
    Boolean above_most "x > level: a short while in every period";
    discrete Integer hits(start=0, fixed=true) "Number of rising edges of above_most";
    discrete Integer misses(start=0, fixed=true) "Number of rising edges of above_one";
  equation
    der(x) = v;
    der(v) = -x;
    above_one = x > 1.0001;
    above_most = x > level;
    when above_most then
      hits = pre(hits) + 1;
    end when;
    when above_one then
      misses = pre(misses) + 1;
    end when;
  end Grazing;

  model Simultaneous "Two relations that change at exactly the same time, and one just after"
    Real x(start=0, fixed=true);
    Real y(start=0, fixed=true);
    discrete Integer a(start=0, fixed=true);
    discrete Integer b(start=0, fixed=true);
    discrete Integer both(start=0, fixed=true) "Counts the events at which both conditions become true";
    Real z(start=0, fixed=true);
  equation
    der(x) = 1;
    der(y) = 2;
    when x > 0.5 then
      a = pre(a) + 1;
    end when;
    when y > 1 then
      b = pre(b) + 1;
    end when;
    when x > 0.5 and y > 1 then
      both = pre(both) + 1;
    end when;
    der(z) = if x > 0.5000001 then 2 elseif y > 1 then 1 else 0;
  end Simultaneous;

  model EventChain "One event sets off the next at the same time: the iteration needs several passes"
    Real x(start=0, fixed=true);
    discrete Integer first(start=0, fixed=true);
    discrete Integer second(start=0, fixed=true);
    discrete Integer third(start=0, fixed=true);
    discrete Real t_third(start=-1, fixed=true);
  equation
    der(x) = 1;
    when x > 0.3 then
      first = pre(first) + 1;
    end when;
    when pre(first) > 0 then
      second = pre(second) + 10;
    end when;
    when pre(second) > 5 then
      third = pre(third) + 100;
      t_third = time;
    end when;
  end EventChain;

  model WhenPriority "when with elsewhen: the first true branch wins"
    Real x(start=0, fixed=true);
    discrete Integer k(start=0, fixed=true);
    discrete Integer n(start=0, fixed=true);
  equation
    der(x) = 1;
    when x > 0.2 then
      k = 1;
      n = pre(n) + 1;
    elsewhen x > 0.4 then
      k = 2;
      n = pre(n) + 1;
    elsewhen {x > 0.6, x > 0.8} then
      k = pre(k) + 10;
      n = pre(n) + 1;
    end when;
  end WhenPriority;

  model EdgeAndChange "edge() and change() of Booleans and Integers"
    Real x(start=0.6, fixed=true);
    Real v(start=0.8, fixed=true);
    Boolean positive(start=true) "x > 0";
    Integer quadrant(start=1) "1 to 4";
    discrete Integer rising(start=0, fixed=true);
    discrete Integer falling(start=0, fixed=true);
    discrete Integer turns(start=0, fixed=true);
  equation
    der(x) = v;
    der(v) = -x;
    positive = x > 0;
    quadrant = if x > 0 then (if v > 0 then 1 else 2) else (if v > 0 then 4 else 3);
    when edge(positive) then
      rising = pre(rising) + 1;
    end when;
    when not positive then
      falling = pre(falling) + 1;
    end when;
    when change(quadrant) then
      turns = pre(turns) + 1;
    end when;
  end EdgeAndChange;

  model Thresholds "Arrays of Booleans and Integers, given element by element"
    Real x(start=0, fixed=true);
    Boolean above[3];
    Integer level[3];
    Real z(start=0, fixed=true);
  equation
    der(x) = 1;
    above[1] = x > 0.2;
    above[2] = x > 0.4;
    above[3] = x > 0.6;
    level[1] = if above[1] then 1 else 0;
    level[2] = if above[2] then 2 else 0;
    level[3] = if above[3] then 3 else 0;
    der(z) = sum(level);
  end Thresholds;

  model StartsOnRoot "The relation is exactly at its threshold at the start, and true right after"
    Real x(start=0, fixed=true);
    Real z(start=0, fixed=true);
    Boolean positive;
    discrete Integer rises(start=0, fixed=true);
  equation
    der(x) = 1;
    positive = x > 0;
    der(z) = if positive then 2 else 0;
    when positive then
      rises = pre(rises) + 1;
    end when;
  end StartsOnRoot;

  model SharedThresholds "Relations of the same two numbers, of which some hold where these are equal"
    Real x(start=0, fixed=true);
    Boolean above, at_least;
    Boolean past[2];
    Real y(start=0, fixed=true);
    Real z(start=0, fixed=true);
  equation
    der(x) = 1;
    above = x > 0;
    at_least = x >= 0;
    past[1] = x > 0.5;
    past[2] = not x <= 0.5;
    der(y) = (if above then 1 else 0) + (if at_least then 2 else 0);
    der(z) = (if past[1] then 1 else 0) + (if past[2] then 2 else 0) + (if x >= 0.5 then 4 else 0);
  end SharedThresholds;

  model SignOf "Between the two sides of zero is zero"
    Real x(start=1, fixed=true);
    Integer sign_of;
    discrete Integer changes(start=0, fixed=true);
    discrete Integer between(start=0, fixed=true) "How often it was zero";
  equation
    der(x) = -1;
    sign_of = if x > 0 then 1 elseif x < 0 then -1 else 0;
    when change(sign_of) then
      changes = pre(changes) + 1;
      between = pre(between) + (if sign_of == 0 then 1 else 0);
    end when;
  end SignOf;

  model Latch "Two gates that feed each other: they settle where one waits for the other"
    parameter Real t_reset = 0.7;
    Boolean q(start=false), q_bar(start=false);
    Real level, level_bar;
    discrete Integer changes(start=0, fixed=true);
    Real z(start=0, fixed=true);
  equation
    level = if q then 1 else 0;
    level_bar = if q_bar then 1 else 0;
    q = not (level_bar > 0.5 or time > t_reset and time < t_reset + 0.1);
    q_bar = not (level > 0.5 or time > 0.3 and time < 0.4);
    der(z) = level;
    when change(q) then
      changes = pre(changes) + 1;
    end when;
  end Latch;

  model AfterInitial "What initial() makes true counts as pre() in the first event"
    Real x(start=0, fixed=true);
    Integer k(start=0);
    discrete Integer n(start=0, fixed=true);
    discrete Integer m(start=0, fixed=true);
  equation
    der(x) = 1;
    k = if initial() then 7 else pre(k);
    when pre(k) == 7 then
      n = pre(n) + 1;
    end when;
    when {initial(), x > 0.5} then
      m = pre(m) + 1;
    end when;
  end AfterInitial;

  model TrueAtStart "A when-condition that holds from the start does not fire until it has been false"
    Real x(start=1, fixed=true);
    Real v(start=0, fixed=true);
    discrete Integer n(start=0, fixed=true);
  equation
    der(x) = v;
    der(v) = -x;
    when x > 0.5 then
      n = pre(n) + 1;
    end when;
  end TrueAtStart;

  model ReinitChain "A reinit that sets off a second one at the same instant"
    Real x(start=0, fixed=true);
    Real y(start=0, fixed=true);
  equation
    der(x) = 1;
    der(y) = 1;
    when x > 0.5 then
      reinit(y, 2*x);
    end when;
    when y > 0.9 then
      reinit(x, 10*y);
    end when;
  end ReinitChain;

  model IntegerEvents "floor, ceil, mod, rem, div and integer of a continuous variable"
    Real u;
    Real f, c, m, r, d;
    Integer i;
    Real z(start=0, fixed=true) "Integral of the floor";
    Real w(start=0, fixed=true) "Integral of the quotient";
  equation
    u = 3*sin(time) + 0.1;
    f = floor(u);
    c = ceil(u);
    m = mod(u, 0.7);
    r = rem(u, 0.7);
    d = div(u, 0.7);
    i = integer(u);
    der(z) = f;
    der(w) = d;
  end IntegerEvents;

  model ExactSteps "A line that meets whole numbers exactly, with no other event that would hide a missed one"
    Real u "From 3 to -3";
    Real d, r;
  equation
    u = 3 - time;
    d = div(u, 1);
    r = rem(u, 1);
  end ExactSteps;

  model StepsInRelations "Whole numbers that jump exactly onto the bound with which they are compared"
    Real x(start=0, fixed=true);
    Real y(start=0, fixed=true);
    Real z(start=0, fixed=true);
    Real w(start=0, fixed=true);
    Integer n(start=0, fixed=true);
  equation
    der(x) = 4;
    der(y) = if floor(x) >= 1 then 2 else 1;
    der(z) = if ceil(x) < 2 then 1 else 2;
    der(w) = if mod(integer(x), 3) > 1 then 1 else 0;
    when div(3*time, 2) >= 1 then
      n = pre(n) + 1;
    end when;
  end StepsInRelations;

  model RelationsInRelations "Relations that hold for a short time after a jump inside of them"
    Real x(start=0.1, fixed=true);
    Real y(start=0, fixed=true);
    Integer n(start=0, fixed=true), k(start=0, fixed=true), m(start=0, fixed=true);
  equation
    der(x) = 1;
    der(y) = if x - 0.4*floor(x/0.4) < 0.001 then 1 else 0;
    when mod(x, 0.4) < 0.001 then
      n = pre(n) + 1;
    end when;
    when (if x > 1 then x - 1 else 5) < 0.001 then
      k = pre(k) + 1;
    elsewhen max(if time > 1.2 and x < 1.301 then 1 else 0, 0) > 0.5 then
      k = pre(k) + 10;
    end when;
    when (if noEvent(x) > 0.5 then x else 0) > 0.6 then
      m = pre(m) + 1;
    end when;
  end RelationsInRelations;

  model FasterThanSteps "A Schmitt trigger whose states let the steps grow beyond its period"
    Real x(start=0, fixed=true);
    Real s;
    Boolean h(start=false, fixed=true);
    Real y(start=0, fixed=true);
  equation
    der(x) = 1;
    s = sin(60*x);
    h = s > 0.9 or pre(h) and s > -0.9;
    der(y) = if h then 1 else 0;
  end FasterThanSteps;

  model SharedZero "The same zero as that of two opposite relations, by way of a parameter"
    parameter Real k = 0;
    Real s;
    Boolean below;
    Integer first(start=2, fixed=true);
    Integer second(start=0, fixed=true);
  equation
    s = sin(3*time - 1.5);
    below = s < 0;
    when s > 0 then
      first = pre(first) + 1;
    end when;
    when s > k then
      second = first;
    end when;
  end SharedZero;

  model PassingCondition "A condition that holds only until another equation of the instant has its new value"
    Boolean tick(start=false, fixed=true);
    Integer n(start=0, fixed=true);
    Integer zeros(start=0, fixed=true);
  equation
    tick = time >= 0.5;
    n = if edge(tick) then pre(n) + 1 else pre(n);
    when edge(tick) and n == 0 then
      zeros = pre(zeros) + 1;
    end when;
  end PassingCondition;

  model StaysAtZero "A relation that is false from where its root becomes zero and stays so"
    Real u;
    Real above;
    Integer n(start=0, fixed=true);
    Real w(start=0, fixed=true);
  equation
    u = 2*sin(3*time);
    above = max(u - 1, 0);
    der(w) = if above > 0 then 1 else 0;
    when above > 0 then
      n = pre(n) + 1;
    end when;
  end StaysAtZero;

  model BreaksAway "Friction in a loop: at the event, each side of the relation contradicts itself by rounding errors"
    parameter Real F = 2;
    Real v(start=0, fixed=true);
    Real a;
    Real s "The force, or the acceleration from 1 on";
    Boolean slides;
  equation
    der(v) = a;
    slides = s > 1;
    a = if slides then s - 1 else 0;
    3.4*a = F*sin(5*time) - (if slides then 1 else s);
  end BreaksAway;

  model NoEvents "noEvent and smooth: the same kinks without events"
    Real x(start=-1, fixed=true);
    Real kinked "max(x, 0) written with noEvent";
    Real smoothed "A smooth join";
    Real z(start=0, fixed=true);
  equation
    der(x) = 1;
    kinked = noEvent(if x > 0 then x else 0);
    smoothed = smooth(1, if x > 0.5 then (x - 0.5)^2 else 0);
    der(z) = kinked + smoothed;
  end NoEvents;

  model Stopping "terminate() at a state event"
    Real h(start=1, fixed=true);
    Real v(start=0, fixed=true);
  equation
    der(h) = v;
    der(v) = -2;
    when h < 0 then
      terminate("the body has reached the ground");
    end when;
  end Stopping;

  model Asserting "An assert of each level"
    parameter Real limit = 10 "Error above";
    parameter Real warn = 10 "Warning above";
    Real x(start=0, fixed=true);
  equation
    der(x) = 1;
    assert(x < warn, "x is large", AssertionLevel.warning);
    assert(x < limit, "x has passed its limit");
  end Asserting;
end StateEvents;
