within PreloadedSprings.Springs;
model TableAssembly "Load-deflection curve of straight segments, given by a table"
  extends Interfaces.ForceElement;
  parameter Units.Length x_i[:] = {0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3} "Travel at which each segment begins";
  parameter Units.Stiffness k_i[size(x_i, 1)] = {430e3, 2625, 1028e3, 5600} "Stiffness of each segment";
  Boolean isReached[size(x_i, 1)] "True where the travel is beyond the beginning of the segment";
  Units.Force f_i[size(x_i, 1)] "Force that each segment contributes";
  Units.Energy E_i[size(x_i, 1)] "Energy that each segment contributes";
protected
  final parameter Integer n = size(x_i, 1) "Number of segments";
equation
  for i in 1:n loop
    isReached[i] = x > x_i[i];
  end for;
  for i in 1:n - 1 loop
    f_i[i] = if isReached[i + 1] then k_i[i]*(x_i[i + 1] - x_i[i]) elseif isReached[i] then k_i[i]*(x - x_i[i]) else 0;
    E_i[i] = if isReached[i + 1] then f_i[i]*(x - (x_i[i] + x_i[i + 1])/2) else f_i[i]*(x - x_i[i])/2;
  end for;
  f_i[n] = if isReached[n] then k_i[n]*(x - x_i[n]) else 0;
  E_i[n] = f_i[n]*(x - x_i[n])/2;
  f = sum(f_i);
  E = sum(E_i);
initial equation
  assert(x_i[1] >= 0, getInstanceName() + ".x_i[1] must not be negative, but is " + String(x_i[1]) + " m");
  for i in 2:n loop
    assert(x_i[i] > x_i[i - 1], getInstanceName() + ".x_i[" + String(i) + "] must be greater than x_i["
       + String(i - 1) + "] = " + String(x_i[i - 1]) + " m, but is " + String(x_i[i]) + " m");
  end for;
  for i in 1:n loop
    assert(k_i[i] > 0, getInstanceName() + ".k_i[" + String(i) + "] must be positive, but is " + String(k_i[i])
       + " N/m");
  end for;

  annotation (
    defaultComponentName = "table",
    Icon(coordinateSystem(extent = {{-100, -100}, {100, 100}}), graphics = {
      Rectangle(extent = {{-80, 54}, {80, -54}}, lineColor = {64, 64, 64}, fillColor = {255, 255, 255},
        fillPattern = FillPattern.Solid),
      Line(points = {{-90, 0}, {-80, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{80, 0}, {90, 0}}, color = {0, 127, 0}, thickness = 0.5),
      Line(points = {{-66, 44}, {-66, -40}, {68, -40}}, color = {192, 192, 192}),
      Line(points = {{-66, -40}, {-58, -40}, {-48, 6}, {14, 14}, {20, 30}, {66, 42}}, color = {0, 127, 0},
        thickness = 0.5),
      Ellipse(extent = {{-61, -37}, {-55, -43}}, lineColor = {0, 127, 0}, fillColor = {0, 127, 0},
        fillPattern = FillPattern.Solid),
      Ellipse(extent = {{-51, 9}, {-45, 3}}, lineColor = {0, 127, 0}, fillColor = {0, 127, 0},
        fillPattern = FillPattern.Solid),
      Ellipse(extent = {{11, 17}, {17, 11}}, lineColor = {0, 127, 0}, fillColor = {0, 127, 0},
        fillPattern = FillPattern.Solid),
      Ellipse(extent = {{17, 33}, {23, 27}}, lineColor = {0, 127, 0}, fillColor = {0, 127, 0},
        fillPattern = FillPattern.Solid)}),
    Documentation(info = "<html>
<p>The force is zero up to <code>x_i[1]</code>; from <code>x_i[i]</code> to <code>x_i[i + 1]</code> it grows with
the stiffness <code>k_i[i]</code>, and the last segment has no end. The number of segments is that of the
table. This is the form of the paper's Table 1, to which a measured load-deflection curve is fitted; the
preset values are the table's forward side.</p>
<p>With the four segments of an <a href=\"modelica://PreloadedSprings.Springs.ActuatorAssembly\">actuator
assembly</a>, both give the same force to rounding
(<a href=\"modelica://PreloadedSprings.Examples.ComponentAgainstTable\">example</a>).</p>
<p>Each segment contributes the force <code>f_i</code> that has been built up along it, so that no large
numbers of opposite sign are added. Each beginning of a segment is one state event. The travels must
increase and the stiffnesses be positive; other values stop the simulation at its start.</p>
</html>"));
end TableAssembly;
