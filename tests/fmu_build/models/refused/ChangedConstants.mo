package ChangedConstants "A medium and one that differs from it by a constant, in one model"
  package Water
    constant Real density = 1000;
    constant Real weight = 9.81*density;
  end Water;
  package Brine
    extends Water(density = 1200);
  end Brine;
  model Columns
    Real p = Water.weight*time; // here
    Real q = Brine.weight*time;
  end Columns;
end ChangedConstants;
