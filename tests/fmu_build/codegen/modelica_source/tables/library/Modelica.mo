package Modelica "Stands in for the table blocks of the Modelica Standard Library, which are written in the same way"
  package Constants
    final constant Real inf = 1e60;
  end Constants;

  package Utilities
    package Files
      function loadResource "File of a URI"
        input String uri;
        output String fileReference;
      external "C" fileReference = loadResource(uri);
      end loadResource;
    end Files;
  end Utilities;

  package Blocks
    package Interfaces
      connector RealInput = input Real;
      connector RealOutput = output Real;

      partial block SIMO
        parameter Integer nout = 1;
        RealInput u;
        RealOutput y[nout];
      end SIMO;

      partial block MIMOs
        parameter Integer n = 1;
        RealInput u[n];
        RealOutput y[n];
      end MIMOs;

      partial block SI2SO
        RealInput u1;
        RealInput u2;
        RealOutput y;
      end SI2SO;

      partial block MI2MO
        parameter Integer n = 1;
        RealInput u1[n];
        RealInput u2[n];
        RealOutput y[n];
      end MI2MO;

      partial block MO
        parameter Integer nout = 1;
        RealOutput y[nout];
      end MO;
    end Interfaces;

    package Types
      type Smoothness = enumeration(LinearSegments, ContinuousDerivative, ConstantSegments,
        MonotoneContinuousDerivative1, MonotoneContinuousDerivative2, ModifiedContinuousDerivative);
      type Extrapolation = enumeration(HoldLastPoint, LastTwoPoints, Periodic, NoExtrapolation);
      type TimeEvents = enumeration(Always, AtDiscontinuities, NoTimeEvents);

      class ExternalCombiTable "Instead of one class for each kind of table"
        extends ExternalObject;
        function constructor
          input Real table[:, :];
          output ExternalCombiTable tableID;
        external "C" tableID = tableInit(table, size(table, 1), size(table, 2));
        end constructor;
        function destructor
          input ExternalCombiTable tableID;
        external "C" tableClose(tableID);
        end destructor;
      end ExternalCombiTable;

      class ExternalCombiTable1D "Instead of one class for each kind of table"
        extends ExternalObject;
        function constructor
          input Real table[:, :];
          output ExternalCombiTable1D tableID;
        external "C" tableID = tableInit(table, size(table, 1), size(table, 2));
        end constructor;
        function destructor
          input ExternalCombiTable1D tableID;
        external "C" tableClose(tableID);
        end destructor;
      end ExternalCombiTable1D;
      class ExternalCombiTable2D = ExternalCombiTable;
      class ExternalCombiTimeTable = ExternalCombiTable;
    end Types;

    package Tables
      block CombiTable1Ds
        extends Interfaces.SIMO(final nout = size(columns, 1));
        parameter Boolean tableOnFile = false annotation (Dialog(group = "Table"));
        parameter Real table[:, :] = fill(0.0, 0, 2) "Equation of the curve" annotation (Dialog(group = "Table"));
        parameter String tableName = "NoName";
        parameter String fileName = "NoName";
        parameter Integer columns[:] = 2:size(table, 2);
        parameter Types.Smoothness smoothness = Types.Smoothness.LinearSegments;
        parameter Types.Extrapolation extrapolation = Types.Extrapolation.LastTwoPoints;
        parameter Boolean verboseExtrapolation = false;
        final parameter Real u_min = Internal.getTable1DAbscissaUmin(tableID);
      protected
        parameter Types.ExternalCombiTable1D tableID = Types.ExternalCombiTable1D(table);
      equation
        for i in 1:nout loop
          y[i] = Internal.getTable1DValue(tableID, i, u);
        end for;
        annotation (Documentation(info = "no derivatives"));
      end CombiTable1Ds;

      block CombiTable1Dv
        extends Interfaces.MIMOs(final n = size(columns, 1));
        parameter Boolean tableOnFile = false;
        parameter Real table[:, :] = fill(0.0, 0, 2);
        parameter String tableName = "NoName";
        parameter String fileName = "NoName";
        parameter Integer columns[:] = 2:size(table, 2);
        parameter Types.Smoothness smoothness = Types.Smoothness.LinearSegments;
        parameter Types.Extrapolation extrapolation = Types.Extrapolation.LastTwoPoints;
        parameter Boolean verboseExtrapolation = false;
        final parameter Real u_min = Internal.getTable1DAbscissaUmin(tableID);
      protected
        parameter Types.ExternalCombiTable1D tableID = Types.ExternalCombiTable1D(table);
      equation
        for i in 1:n loop
          y[i] = Internal.getTable1DValue(tableID, i, u[i]);
        end for;
      end CombiTable1Dv;

      block CombiTable2Ds
        extends Interfaces.SI2SO;
        extends Internal.CombiTable2DBase;
      equation
        y = Internal.getTable2DValue(tableID, u1, u2);
      end CombiTable2Ds;

      block CombiTable2Dv
        extends Interfaces.MI2MO;
        extends Internal.CombiTable2DBase;
      equation
        for i in 1:n loop
          y[i] = Internal.getTable2DValue(tableID, u1[i], u2[i]);
        end for;
      end CombiTable2Dv;

      package Internal
        partial block CombiTable2DBase
          parameter Boolean tableOnFile = false;
          parameter Real table[:, :] = fill(0.0, 0, 2);
          parameter String tableName = "NoName";
          parameter String fileName = "NoName";
          parameter Types.Smoothness smoothness = Types.Smoothness.LinearSegments;
          parameter Types.Extrapolation extrapolation = Types.Extrapolation.LastTwoPoints;
          parameter Boolean verboseExtrapolation = false;
          final parameter Real u_min[2] = getTable2DAbscissaUmin(tableID);
        protected
          parameter Types.ExternalCombiTable2D tableID = Types.ExternalCombiTable2D(table);
        equation
          assert(size(table, 1) > 0, "table is empty");
        end CombiTable2DBase;

        function getTable1DValue
          input Types.ExternalCombiTable1D tableID;
          input Integer column;
          input Real u;
          output Real y;
        external "C" y = tableValue(tableID, column, u);
        end getTable1DValue;
        function getTable1DValueNoDer
          input Types.ExternalCombiTable1D tableID;
          input Integer column;
          input Real u;
          output Real y;
        external "C" y = tableValue(tableID, column, u);
        end getTable1DValueNoDer;
        function getTable1DValueNoDer2
          input Types.ExternalCombiTable1D tableID;
          input Integer column;
          input Real u;
          output Real y;
        external "C" y = tableValue(tableID, column, u);
        end getTable1DValueNoDer2;
      end Internal;
    end Tables;

    package Sources
      block CombiTimeTable
        extends Interfaces.MO(final nout = max([size(columns, 1); size(offset, 1)]));
        parameter Boolean tableOnFile = false;
        parameter Real table[:, :] = fill(0.0, 0, 2);
        parameter String tableName = "NoName";
        parameter String fileName = "NoName";
        parameter Integer columns[:] = 2:size(table, 2);
        parameter Types.Smoothness smoothness = Types.Smoothness.LinearSegments;
        parameter Types.Extrapolation extrapolation = Types.Extrapolation.LastTwoPoints;
        parameter Real timeScale = 1 annotation (Evaluate = true);
        parameter Real offset[:] = {0};
        parameter Real startTime = 0;
        parameter Real shiftTime = startTime;
        parameter Types.TimeEvents timeEvents = Types.TimeEvents.Always;
        parameter Boolean verboseExtrapolation = false;
        final parameter Real t_min = Tables.Internal.getTimeTableTmin(tableID);
      protected
        parameter Types.ExternalCombiTimeTable tableID = Types.ExternalCombiTimeTable(table);
        discrete Real nextTimeEvent(start = 0, fixed = true);
      equation
        when {time >= pre(nextTimeEvent), initial()} then
          nextTimeEvent = Tables.Internal.getNextTimeEvent(tableID, time);
        end when;
        for i in 1:nout loop
          y[i] = offset[1] + Tables.Internal.getTimeTableValue(tableID, i, time);
        end for;
        annotation (Documentation(info = "time events"));
      end CombiTimeTable;
    end Sources;
  end Blocks;
end Modelica;
