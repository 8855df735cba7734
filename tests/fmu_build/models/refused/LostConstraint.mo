model LostConstraint "Modifiers of a constraining class"
  model Part
    parameter Real k = 1; // here
    Real y;
  equation
    y = k*time;
  end Part;
  replaceable Part part constrainedby Part(k=4);
end LostConstraint;
