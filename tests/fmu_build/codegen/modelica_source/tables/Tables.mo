package Tables "Models with tables"
  model Inputs "Tables of inputs"
    parameter Real curves[6, 3] = [-1, 0, 1; 0.5, 2, 2; 1, 1, 5; 2.5, 1, 6; 4, 0, 6.5; 4.5, -3, 6];
    parameter Real area[4, 5] = [0, 1, 2, 3.5, 4; -1, 2, 3, 1, 3; 2, 6, 1, 4, 1; 4, 5, 6, 2, 1];
    input Real u(start = 0);
    input Real v(start = 0);
    output Real y[5];
    Modelica.Blocks.Tables.CombiTable1Ds single(table = curves, columns = {3, 2});
    Modelica.Blocks.Tables.CombiTable1Dv several(table = curves);
    Modelica.Blocks.Tables.CombiTable2Ds surface(table = area);
    Real x(start = 0, fixed = true);
  equation
    single.u = u;
    several.u = {u, v};
    surface.u1 = u;
    surface.u2 = v;
    der(x) = single.y[1];
    y = {single.y[1], single.y[2], several.y[1], several.y[2], surface.y};
    annotation (uses(Modelica(version = "1")));
  end Inputs;

  model Times "A table over time and its integral"
    parameter Real start = 0;
    parameter Real shift = 0;
    Modelica.Blocks.Sources.CombiTimeTable source(
      startTime = start, shiftTime = shift,
      table = [-0.4, 1, 0; 0.3, 2, 0; 0.3, -1, 0; 1.1, 0.5, 1; 1.100001, 0.5, 3; 2, -2, 0],
      offset = {0.5});
    output Real y = source.y[1];
    output Real x(start = 0, fixed = true);
  equation
    der(x) = source.y[1];
    annotation (uses(Modelica(version = "1")));
  end Times;

  model Scaled "The time scale of a table is fixed"
    Modelica.Blocks.Sources.CombiTimeTable source(
      table = [0, 0; 0.1, 3; 0.2, 1; 0.2, 2; 0.7, 0], timeScale = 3, startTime = 0.3, shiftTime = 0.1,
      extrapolation = Modelica.Blocks.Types.Extrapolation.Periodic);
    output Real y = source.y[1];
    output Real x(start = 0, fixed = true);
  equation
    der(x) = source.y[1];
    annotation (uses(Modelica(version = "1")));
  end Scaled;

  model Spring "Oscillates on a nonlinear spring"
    Modelica.Blocks.Tables.CombiTable1Ds spring(
      table = [-2, -9; -1, -2; 1, 2; 2, 9], smoothness = Modelica.Blocks.Types.Smoothness.LinearSegments);
    output Real s(start = 1.8, fixed = true);
    output Real v(start = 0, fixed = true);
  equation
    der(s) = v;
    der(v) = -spring.y[1];
    spring.u = s;
    annotation (uses(Modelica(version = "1")));
  end Spring;

  model Files "Tables in files beside the model"
    Modelica.Blocks.Tables.CombiTable1Ds curve(
      tableOnFile = true, tableName = "curve", fileName = "curves.txt", columns = {3, 2});
    Modelica.Blocks.Tables.CombiTable2Ds surface(
      tableOnFile = true,
      tableName = "surface",
      fileName = Modelica.Utilities.Files.loadResource("modelica://Tables/curves.txt"));
    Modelica.Blocks.Sources.CombiTimeTable source(tableOnFile = true, tableName = "curve", fileName = "curves.txt");
    output Real y[4] = {curve.y[1], curve.y[2], surface.y, sum(source.y)};
  equation
    curve.u = time;
    surface.u1 = time;
    surface.u2 = 1.5;
    annotation (uses(Modelica(version = "1")));
  end Files;

  model NamedElsewhere
    parameter String place = "curves.txt";
    Modelica.Blocks.Sources.CombiTimeTable source(tableOnFile = true, tableName = "curve", fileName = place);
    output Real y = source.y[1];
    annotation (uses(Modelica(version = "1")));
  end NamedElsewhere;

  model Chosen
    parameter Boolean useFile = true;
    Modelica.Blocks.Sources.CombiTimeTable source(
      tableOnFile = useFile, table = [0, 0; 1, 1], tableName = "curve", fileName = "curves.txt");
    output Real y = source.y[1];
    annotation (uses(Modelica(version = "1")));
  end Chosen;

  model Mounted
    extends Modelica.Blocks.Sources.CombiTimeTable(tableOnFile = true, tableName = "curve", fileName = "curves.txt");
    annotation (uses(Modelica(version = "1")));
  end Mounted;

  model Decreasing
    Modelica.Blocks.Tables.CombiTable1Ds source(table = [0, 0; 1, 1; 1, 2]);
    output Real y = source.y[1];
  equation
    source.u = time;
    annotation (uses(Modelica(version = "1")));
  end Decreasing;

  model Beyond
    Modelica.Blocks.Sources.CombiTimeTable source(
      table = [0, 0; 0.5, 1], extrapolation = Modelica.Blocks.Types.Extrapolation.NoExtrapolation);
    output Real y = source.y[1];
    annotation (uses(Modelica(version = "1")));
  end Beyond;

  model SmoothSurface
    Modelica.Blocks.Tables.CombiTable2Ds source(
      table = [0, 1, 2; 1, 1, 2; 2, 1, 3], smoothness = Modelica.Blocks.Types.Smoothness.ContinuousDerivative);
    output Real y = source.y;
  equation
    source.u1 = time;
    source.u2 = time;
    annotation (uses(Modelica(version = "1")));
  end SmoothSurface;
end Tables;
