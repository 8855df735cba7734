model Rubbing "Slowed down by a torque from a table object of its own, as friction elements of MSL 4.1 have it"
  import Modelica.Blocks.Types.{ExternalCombiTable1D, Extrapolation, Smoothness};
  import Modelica.Blocks.Tables.Internal.{getTable1DValue, getTable1DValueNoDer, getTable1DValueNoDer2};
  parameter Real tau_pos[:, 2] = [0, 1; 2, 3];
  parameter Smoothness smoothness = Smoothness.LinearSegments;
  parameter Real atRest(unit="N.m") =
    if     smoothness == Smoothness.ConstantSegments then getTable1DValueNoDer(tableID, 1, 0)
    elseif smoothness == Smoothness.LinearSegments   then getTable1DValueNoDer2(tableID, 1, 0)
    else                                                  getTable1DValue(tableID, 1, 0) "Torque at rest";
  parameter Real half = atRest/2 "Torque of a drive";
  Real w(start = 5, fixed = true);
protected
  final parameter ExternalCombiTable1D tableID = ExternalCombiTable1D(
    tableName="NoName",
    fileName="NoName",
    table=tau_pos,
    columns={2},
    smoothness=smoothness,
    extrapolation=Extrapolation.LastTwoPoints,
    verboseRead=false) "Table of torques";
equation
  der(w) = half - (
    if     smoothness == Smoothness.ConstantSegments then getTable1DValueNoDer(tableID, 1, w)
    elseif smoothness == Smoothness.LinearSegments   then getTable1DValueNoDer2(tableID, 1, w)
    else                                                  getTable1DValue(tableID, 1, w));
end Rubbing;
