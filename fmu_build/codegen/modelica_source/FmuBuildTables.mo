package FmuBuildTables "Interpolation in tables, as the C functions of the Modelica Standard Library have it"
  /* Smoothness: 1 LinearSegments, 2 ContinuousDerivative (Akima), 3 ConstantSegments, 4 MonotoneContinuousDerivative1
     (Fritsch and Butland), 5 MonotoneContinuousDerivative2 (Steffen), 6 ModifiedContinuousDerivative (modified Akima).
     Extrapolation: 1 HoldLastPoint, 2 LastTwoPoints, 3 Periodic, 4 NoExtrapolation.

     The functions that blocks call differ from all others in the order of their inputs: the generator tells call
     sites that rumoca has not evaluated by the shapes of these. */

  function rowBelow "Last row but the final one whose first value is not above x; the first if there is none"
    input Real table[:, :] "First column not decreasing";
    input Real x;
    input Integer first = 1 "First row of the grid";
    output Integer row;
  protected
    Integer above "A row above it";
    Integer middle;
  algorithm
    row := first;
    above := size(table, 1);
    for step in 1:integer(ceil(log(size(table, 1))/log(2))) loop
      middle := integer((row + above)/2);
      if middle > row then
        if table[middle, 1] <= x then
          row := middle;
        else
          above := middle;
        end if;
      end if;
    end for;
  end rowBelow;

  function secant "Slope of the line between rows k and k + 1; lines outside of the table continue the outermost two"
    input Real table[:, :] "At least three rows, if a line outside is asked for";
    input Integer column;
    input Integer k "From -1 to size(table, 1) + 1";
    output Real slope;
  protected
    Integer near "The nearest line inside";
    Integer next "Its neighbour";
    Real nearest;
  algorithm
    near := max(1, min(size(table, 1) - 1, k));
    nearest := (table[near + 1, column] - table[near, column])/(table[near + 1, 1] - table[near, 1]);
    if near == k then
      slope := nearest;
    else
      next := if k < 1 then 2 else size(table, 1) - 2;
      slope := nearest + abs(k - near)*(nearest -
        (table[next + 1, column] - table[next, column])/(table[next + 1, 1] - table[next, 1]));
    end if;
  end secant;

  function slopeAtRow "Slope of a smooth interpolation at row k of at least three"
    input Real table[:, :];
    input Integer column;
    input Integer smoothness "2, 4, 5 or 6";
    input Integer k;
    output Real slope;
  protected
    Real d1;
    Real d2 "Slope of the line before the row";
    Real d3 "Slope of the line after the row";
    Real d4;
    Real before;
    Real after;
  algorithm
    d2 := secant(table, column, k - 1);
    d3 := secant(table, column, k);
    if smoothness == 2 or smoothness == 6 then
      d1 := secant(table, column, k - 2);
      d4 := secant(table, column, k + 1);
      before := abs(d2 - d1) + (if smoothness == 6 then abs(d2 + d1)/2 else 0);
      after := abs(d4 - d3) + (if smoothness == 6 then abs(d4 + d3)/2 else 0);
      slope := if before + after > 0 then (after*d2 + before*d3)/(before + after) else (d2 + d3)/2;
    elseif k == 1 then
      slope := d3;
    elseif k == size(table, 1) then
      slope := d2;
    elseif d2*d3 <= 0 then
      slope := 0;
    else
      before := table[k, 1] - table[k - 1, 1];
      after := table[k + 1, 1] - table[k, 1];
      slope := if smoothness == 4 then 3*(before + after)/((before + 2*after)/d2 + (after + 2*before)/d3)
        else (if d2 > 0 then 1 else -1)*min(abs(d2*after + d3*before)/(before + after), 2*min(abs(d2), abs(d3)));
    end if;
  end slopeAtRow;

  function onPiece "Value of the piece between rows k and k + 1, continued beyond it as a line"
    input Real table[:, :];
    input Integer column;
    input Integer smoothness "Not 3";
    input Integer k;
    input Real x;
    output Real y;
  protected
    Real x0;
    Real y0;
    Real h;
    Real line "Slope of the straight line";
    Real s0;
    Real s1;
    Real v;
  algorithm
    x0 := table[k, 1];
    y0 := table[k, column];
    h := table[k + 1, 1] - x0;
    line := (table[k + 1, column] - y0)/h;
    if smoothness == 1 or smoothness == 3 or size(table, 1) < 3 then
      y := y0 + line*(x - x0);
    else
      s0 := slopeAtRow(table, column, smoothness, k);
      s1 := slopeAtRow(table, column, smoothness, k + 1);
      v := max(0, min(h, x - x0));
      y := y0 + (((s0 + s1 - 2*line)*v/h + (3*line - 2*s0 - s1))*v/h + s0)*v
        + (if x < x0 then s0*(x - x0) elseif x > x0 + h then s1*(x - x0 - h) else 0);
    end if;
  end onPiece;

  function wrapped "x moved by whole periods into the range of the first column, if that is repeated and x outside"
    input Real first;
    input Real last;
    input Integer extrapolation;
    input Real x;
    output Real inside;
  algorithm
    inside := if extrapolation <> 3 then x
      elseif x < first then x + ceil((first - x)/(last - first))*(last - first)
      elseif x > last then x - ceil((x - last)/(last - first))*(last - first)
      else x;
  end wrapped;

  function value1D "Value of a table with one input"
    input Integer column;
    input Real table[:, :] "First column strictly increasing";
    input Integer smoothness;
    input Integer extrapolation;
    input Real u;
    output Real y;
  protected
    Integer n = size(table, 1);
    Real x;
    Integer k;
  algorithm
    if n == 1 then
      y := table[1, column];
    else
      x := wrapped(table[1, 1], table[n, 1], extrapolation, u);
      if extrapolation == 1 then
        x := max(table[1, 1], min(table[n, 1], x));
      end if;
      k := rowBelow(table, x);
      if smoothness == 3 and x >= table[1, 1] and x <= table[n, 1] then
        y := if x < table[n, 1] then table[k, column] else table[n, column];
      else
        y := onPiece(table, column, smoothness, k, x);
      end if;
    end if;
  end value1D;

  function columnBelow "Last column but the final one whose first value is not above x; the first if there is none"
    input Real table[:, :] "First row increasing from its second column on";
    input Real x;
    input Integer first = 2 "First column of the grid";
    output Integer column;
  protected
    Integer above "A column above it";
    Integer middle;
  algorithm
    column := first;
    above := size(table, 2);
    for step in 1:integer(ceil(log(size(table, 2))/log(2))) loop
      middle := integer((column + above)/2);
      if middle > column then
        if table[1, middle] <= x then
          column := middle;
        else
          above := middle;
        end if;
      end if;
    end for;
  end columnBelow;

  function value2D "Value of a table with two inputs, linear in each or constant in segments"
    input Integer smoothness "1 or 3";
    input Integer extrapolation;
    input Real table[:, :] "First column and first row strictly increasing from their second value on";
    input Real u1;
    input Real u2;
    output Real y;
  protected
    Integer m = size(table, 1);
    Integer n = size(table, 2);
    Real x1;
    Real x2;
    Boolean inside;
    Integer i;
    Integer j;
    Integer i1;
    Integer j1;
    Real r1;
    Real r2;
  algorithm
    x1 := if m > 2 then wrapped(table[2, 1], table[m, 1], extrapolation, u1) else table[2, 1];
    x2 := if n > 2 then wrapped(table[1, 2], table[1, n], extrapolation, u2) else table[1, 2];
    if extrapolation == 1 then
      x1 := max(table[2, 1], min(table[m, 1], x1));
      x2 := max(table[1, 2], min(table[1, n], x2));
    end if;
    inside := x1 >= table[2, 1] and x1 <= table[m, 1] and x2 >= table[1, 2] and x2 <= table[1, n];
    i := rowBelow(table, x1, 2);
    j := columnBelow(table, x2);
    i1 := min(i + 1, m);
    j1 := min(j + 1, n);
    if smoothness == 3 and inside then
      y := table[if x1 < table[m, 1] then i else m, if x2 < table[1, n] then j else n];
    else
      r1 := if m > 2 then (x1 - table[i, 1])/(table[i1, 1] - table[i, 1]) else 0;
      r2 := if n > 2 then (x2 - table[1, j])/(table[1, j1] - table[1, j]) else 0;
      y := (1 - r1)*((1 - r2)*table[i, j] + r2*table[i, j1]) + r1*((1 - r2)*table[i1, j] + r2*table[i1, j1]);
    end if;
  end value2D;

  /* A table over time. Between events the interval is known: it ends at row `stop` and starts at row `first`.
     stop = 0: before startTime; stop = 1: before the table; stop = size(table, 1) + 1: after it.
     timeEvents: 1 Always, 2 AtDiscontinuities, 3 NoTimeEvents. */

  function periods "Number of periods that are over"
    input Integer extrapolation;
    input Real table[:, :];
    input Real x "Time on the scale of the table";
    output Integer number;
  protected
    Integer n = size(table, 1);
  algorithm
    number := if extrapolation == 3 and n > 1 then integer(floor((x - table[1, 1])/(table[n, 1] - table[1, 1]))) else 0;
  end periods;

  function isJump "Whether two instants differ by no more than rounding errors"
    input Real t0;
    input Real t1;
    output Boolean jumps;
  algorithm
    jumps := t1 - t0 <= 1e-10*max(1e-10, max(abs(t0), abs(t1)));
  end isJump;

  function stopRow "Next row after x where a time event is due"
    input Integer smoothness;
    input Real table[:, :];
    input Integer timeEvents;
    input Real start "startTime on the scale of the table";
    input Real reached "Time on the scale of the table";
    input Real x "The same without whole periods";
    output Integer stop;
  protected
    Integer n = size(table, 1);
    Integer k;
    Boolean isEvent;
  algorithm
    stop := n + 1;
    if reached < start then
      stop := 0;
    elseif n > 1 then
      for i in 1:n loop
        k := n + 1 - i;
        isEvent := k == 1 or k == n or smoothness == 3 or smoothness == 1 and timeEvents == 1
          or smoothness == 1 and timeEvents == 2 and isJump(table[k, 1], table[min(k + 1, n), 1]);
        if isEvent and table[k, 1] > x then
          stop := k;
        end if;
      end for;
    end if;
  end stopRow;

  function firstRow "Row at which the interval starts that ends at a row"
    input Integer smoothness;
    input Integer timeEvents;
    input Real table[:, :];
    input Integer stop;
    output Integer first;
  algorithm
    first := 1;
    if smoothness == 3 or smoothness == 1 and timeEvents == 1 then
      first := max(1, stop - 1);
    elseif smoothness == 1 and timeEvents == 2 then
      for k in 2:size(table, 1) loop
        if k < stop and isJump(table[k - 1, 1], table[k, 1]) then
          first := k;
        end if;
      end for;
    end if;
  end firstRow;

  function eventTime "Time of the event at row stop; 1e60 s if there are no more"
    input Real table[:, :];
    input Integer stop;
    input Integer periods;
    input Real startTime;
    input Real shiftTime;
    input Real timeScale;
    output Real event;
  protected
    Integer n = size(table, 1);
  algorithm
    if stop == 0 then
      event := startTime;
    elseif stop > n then
      event := 1e60;
    else
      event := shiftTime + timeScale*(table[stop, 1] + periods*(table[n, 1] - table[1, 1]));
    end if;
  end eventTime;

  function valueInInterval "Value of a table over time"
    input Integer column;
    input Real table[:, :];
    input Integer smoothness;
    input Integer extrapolation;
    input Integer first;
    input Integer stop;
    input Real x "Time on the scale of the table, without whole periods";
    output Real y;
  protected
    Integer n = size(table, 1);
    Integer k;
  algorithm
    if stop == 0 then
      y := 0;
    elseif n == 1 then
      y := table[1, column];
    elseif stop == 1 or stop > n then
      k := if stop == 1 then 1 else n - 1;
      if extrapolation == 2 and table[k + 1, 1] > table[k, 1] then
        y := onPiece(table, column, smoothness, k, x);
      elseif stop == 1 then
        y := table[1, column];
      else
        y := table[n, column];
      end if;
    else
      k := max(first, min(stop - 1, if first == stop - 1 then first else rowBelow(table, x)));
      if smoothness == 3 then
        y := table[k, column];
      elseif table[k + 1, 1] > table[k, 1] then
        y := onPiece(table, column, smoothness, k, x);
      else
        y := table[k + 1, column];
      end if;
    end if;
  end valueInInterval;

  function leastRowStep "Smallest step of the first column from row `first` on, 1 if there is none"
    input Integer first;
    input Real table[:, :];
    output Real step;
  algorithm
    step := 1;
    for k in 2:size(table, 1) loop
      step := if k > first then min(step, table[k, 1] - table[k - 1, 1]) else step;
    end for;
  end leastRowStep;

  function leastColumnStep "Smallest step of the first row from its second value on, 1 if there is none"
    input Real table[:, :];
    output Real step;
  algorithm
    step := 1;
    for k in 3:size(table, 2) loop
      step := min(step, table[1, k] - table[1, k - 1]);
    end for;
  end leastColumnStep;
end FmuBuildTables;
