package Sampling "sample(), discrete states and discrete controllers"
  model Counter "No states: a discrete counter"
    parameter Integer step = 2 "Increment";
    discrete Integer k(start=0, fixed=true);
    discrete Boolean odd(start=false, fixed=true);
    Real y "Linear in the counter";
  equation
    when sample(0, 0.125) then
      k = pre(k) + step;
      odd = not pre(odd);
    end when;
    y = 0.5*k;
  end Counter;

  model SampledPI "A discrete PI controller on a continuous first-order plant"
    parameter Real k_p = 2 "Proportional gain";
    parameter Real k_i = 0.5 "Integral gain, per sample";
    parameter Real reference = 1 "Set point";
    Real x(start=0, fixed=true) "Plant";
    discrete Real e(start=0, fixed=true) "Sampled error";
    discrete Real s(start=0, fixed=true) "Sum of errors";
    discrete Real u(start=0, fixed=true) "Held control signal";
  equation
    der(x) = -x + u;
    when sample(0.1, 0.1) then
      e = reference - x;
      s = pre(s) + e;
      u = k_p*e + k_i*s;
    end when;
  end SampledPI;

  model TwoRates "Two samplers; every other tick of the fast one falls on the slow one"
    discrete Integer fast(start=0, fixed=true);
    discrete Integer slow(start=0, fixed=true);
    discrete Integer seen(start=0, fixed=true) "What the slow one sees of the fast one";
    discrete Integer delayed(start=0, fixed=true) "What it sees of its previous value";
    Real x(start=0, fixed=true);
  equation
    der(x) = fast - slow;
    when sample(0.1, 0.1) then
      fast = pre(fast) + 1;
    end when;
    when sample(0.2, 0.2) then
      slow = pre(slow) + 1;
      seen = fast;
      delayed = pre(fast);
    end when;
  end TwoRates;

  model PulseTrain "A pulse train from sample() and a time event at the end of each pulse"
    parameter Real width(unit="s") = 0.03 "Width of a pulse";
    discrete Real t_start(start=-1, fixed=true, unit="s") "Start of the latest pulse";
    Boolean high "Inside a pulse";
    Real y "The pulses";
    Real z(start=0, fixed=true) "Their integral";
  equation
    when sample(0.05, 0.1) then
      t_start = time;
    end when;
    high = time >= t_start and time < t_start + width and t_start > 0;
    y = if high then 2 else 0;
    der(z) = y;
  end PulseTrain;

  model HeldSine "A zero-order hold of a continuous signal"
    Real x(start=0, fixed=true);
    Real v(start=1, fixed=true);
    discrete Real held(start=0, fixed=true);
    discrete Real previous(start=0, fixed=true);
    Real z(start=0, fixed=true) "Integral of the held signal";
  equation
    der(x) = v;
    der(v) = -x;
    der(z) = held;
    when sample(0, 0.25) then
      held = x;
      previous = pre(held);
    end when;
  end HeldSine;
  model SampledReset "A state that is reinitialised at every tick"
    Real x(start=0, fixed=true);
  equation
    der(x) = 1;
    when sample(0.25, 0.25) then
      reinit(x, 0.5*pre(x));
    end when;
  end SampledReset;

  model SampleOrState "One when-clause for a sampler and a state event"
    Real x(start=0, fixed=true);
    discrete Integer n(start=0, fixed=true);
    discrete Real t_last(start=0, fixed=true);
  equation
    der(x) = 1;
    when {sample(0.1, 0.2), x > 0.45} then
      n = pre(n) + 1;
      t_last = time;
    end when;
  end SampleOrState;

  model SampledThreshold "Relations of continuous variables with one that is sampled"
    Real x(start=0, fixed=true);
    Real z(start=0, fixed=true) "Time above the threshold";
    discrete Real d(start=0.3, fixed=true) "Threshold";
    discrete Boolean late(start=false, fixed=true) "As the sampler sees it";
    Boolean above;
    Integer level;
    Integer n(start=0, fixed=true) "How often it was reached";
    Boolean any(start=false, fixed=true) "Whether it ever was";
  equation
    der(x) = 1;
    der(z) = if x > d then 1 else 0;
    above = x > d;
    level = if x*x >= d*d then 2 else 1;
    any = pre(any) or x > d;
    when x > d then
      n = pre(n) + 1;
    end when;
    when sample(0.25, 0.5) then
      d = pre(d) + 0.4;
      late = x > d - 0.5;
    end when;
  end SampledThreshold;

  model Guarded "A sampler that counts only while a relation holds; another when-clause watches the count"
    Real x(start=0, fixed=true);
    discrete Integer n(start=0, fixed=true);
    discrete Integer changes(start=0, fixed=true);
    discrete Real t_third(start=-1, fixed=true) "Time of the third count";
  equation
    der(x) = 1;
    when sample(0.1, 0.2) and x > 0.45 then
      n = pre(n) + 1;
    end when;
    when change(n) then
      changes = pre(changes) + 1;
    end when;
    when n >= 3 then
      t_third = time;
    end when;
  end Guarded;

  model SampledAlgorithm "A sampled algorithm with assignments that build on each other"
    parameter Real T(unit="s") = 0.1 "Sample period; structural";
    Real x(start=0, fixed=true);
    discrete Integer n(start=0, fixed=true);
    discrete Integer k(start=0, fixed=true);
    discrete Real t_n(start=0, fixed=true);
  equation
    der(x) = 1;
  algorithm
    when sample(T, T) then
      n := pre(n) + 1;
      k := 2*n;
      if x > 0.35 then
        k := k + 100;
      end if;
      t_n := n*T;
    end when;
  end SampledAlgorithm;

  model StepGraph "Two steps and two timed transitions, as state graphs are written"
    connector In
      output Boolean occupied;
      input Boolean set;
    end In;

    connector Out
      output Boolean available;
      input Boolean reset;
    end Out;

    connector From
      input Boolean available;
      output Boolean reset;
    end From;

    connector To
      input Boolean occupied;
      output Boolean set;
    end To;

    model Step "Active from the event after it was set"
      parameter Boolean is_first = false;
      In before;
      Out behind;
      Boolean active;
    protected
      Boolean next;
    initial equation
      pre(next) = is_first;
    equation
      active = pre(next);
      next = before.set or active and not behind.reset;
      before.occupied = active;
      behind.available = active;
    end Step;

    model Transition "Fires when it has been enabled for a time"
      parameter Real wait(unit="s") = 1;
      From before;
      To behind;
      Real t "How long it has been enabled";
    protected
      discrete Real t_enabled;
      Boolean enabled, fires;
    initial equation
      pre(t_enabled) = 0;
      pre(enabled) = false;
    equation
      enabled = before.available and not behind.occupied;
      when enabled then
        t_enabled = time;
      end when;
      t = if enabled then time - t_enabled else 0;
      fires = enabled and time >= t_enabled + wait;
      before.reset = fires;
      behind.set = fires;
    end Transition;

    Step a(is_first=true), b;
    Transition ab(wait=1), ba(wait=0.5);
    Real x(start=0, fixed=true) "How long a was active";
  equation
    connect(a.behind, ab.before);
    connect(ab.behind, b.before);
    connect(b.behind, ba.before);
    connect(ba.behind, a.before);
    der(x) = if a.active then 1 else 0;
  end StepGraph;

  model InitialPrevious "The value before the start, by an initial equation"
    parameter Real k = 2;
    Real x(start=3, fixed=true);
    discrete Real d, e;
  initial equation
    pre(d) = k*x + 1;
    2*pre(e) = k;
  equation
    der(x) = 1;
    when x > 3.5 then
      d = pre(d) + x;
      e = pre(e) + 1;
    end when;
  end InitialPrevious;

  model MeanFromStart "The mean of the time over each half second since the start, whenever that is"
    parameter Real f = 2;
    parameter Real t_0(fixed=false);
    Real x(start=0, fixed=true);
    discrete Real mean(start=0, fixed=true);
  initial equation
    t_0 = time;
  equation
    der(x) = time;
    when sample(t_0 + 1/f, 1/f) then
      mean = f*pre(x);
      reinit(x, 0);
    end when;
  end MeanFromStart;

  model LeftLimits "pre() of algebraic variables: their values just before the event"
    Real x(start=1, fixed=true);
    Real y = 2*x, wave = sin(time), root(start=1), sum = x + n;
    Real level = if time < 0.5 then 3 else 1;
    Integer n(start=0, fixed=true);
    discrete Real d[5](each start=0, each fixed=true);
    discrete Real crossing(start=0, fixed=true);
  equation
    der(x) = -x;
    root^3 + root = y;
    when sample(0.25, 0.25) then
      n = pre(n) + 1;
      d = {pre(y), pre(wave), pre(root)^3 + pre(root), sum - pre(sum), pre(level)};
    end when;
    when y < 1.1 then
      crossing = pre(y);
    end when;
  end LeftLimits;
end Sampling;
