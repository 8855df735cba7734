package Modelica "Stands in for the Modelica Standard Library where it is missing: what PreloadedSpringsMSL.Components use"
  package Icons
    partial package Package end Package;
    partial package ExamplesPackage end ExamplesPackage;
    partial model Example end Example;
  end Icons;

  package Units
    package SI
      type Position = Real(final quantity = "Length", final unit = "m");
      type Distance = Position(min = 0);
      type Force = Real(final quantity = "Force", final unit = "N");
      type TranslationalSpringConstant = Real(final quantity = "TranslationalSpringConstant", final unit = "N/m");
    end SI;
  end Units;

  package Mechanics
    package Translational
      package Interfaces
        connector Flange_a
          Units.SI.Position s;
          flow Units.SI.Force f;
        end Flange_a;

        connector Flange_b
          Units.SI.Position s;
          flow Units.SI.Force f;
        end Flange_b;

        partial model PartialTwoFlanges
          Flange_a flange_a;
          Flange_b flange_b;
        end PartialTwoFlanges;

        partial model PartialCompliant
          extends PartialTwoFlanges;
          Units.SI.Position s_rel(start = 0);
          Units.SI.Force f;
        equation
          s_rel = flange_b.s - flange_a.s;
          flange_b.f = f;
          flange_a.f = -f;
        end PartialCompliant;
      end Interfaces;
    end Translational;
  end Mechanics;
end Modelica;
