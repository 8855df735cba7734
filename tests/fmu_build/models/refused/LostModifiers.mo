model LostModifiers "Modifiers of a class that is redeclared in a modifier"
  model Part
    parameter Real k = 1; // here
    Real y;
  equation
    y = k*time;
  end Part;
  model Whole
    replaceable model Kind = Part;
    Kind part;
  end Whole;
  Whole whole(redeclare model Kind = Part(k=4));
end LostModifiers;
