package LibraryChains "Chains of masses composed from the components of the PreloadedSprings library"
  import PreloadedSprings.Parts;
  import PreloadedSprings.Springs;

  model TwoMasses "Two masses and three springs, connected one by one"
    Parts.Fixed leftWall, rightWall;
    Parts.Mass first(m=1, s(start=0, fixed=true), v(start=2, fixed=true));
    Parts.Mass second(m=0.5, s(start=0, fixed=true), v(start=0, fixed=true));
    Springs.RestrainedPreloadedSpring left(k_s=50, k_h=2000, F_0=5, x_0=0.01);
    Springs.RestrainedPreloadedSpring middle(k_s=30, k_h=2000, F_0=3, x_0=0.01);
    Springs.RestrainedPreloadedSpring right(k_s=50, k_h=2000, F_0=5, x_0=0.01);
  equation
    connect(leftWall.flange, left.flange_a);
    connect(left.flange_b, first.flange_a);
    connect(first.flange_b, middle.flange_a);
    connect(middle.flange_b, second.flange_a);
    connect(second.flange_b, right.flange_a);
    connect(right.flange_b, rightWall.flange);
  end TwoMasses;

  model ThreeMasses "Arrays of masses, dampers and springs, connected in loops"
    parameter Integer n = 3 "Number of masses";
    Parts.Fixed wall;
    Parts.Mass mass[n](m={1, 0.7, 1.3}, s(each start=0, each fixed=true), v(start={1.5, 0, -1}, each fixed=true));
    Parts.Damper guide[n](each d=0.5);
    Springs.RestrainedPreloadedSpring spring[n + 1](
      each k_s=50, each k_h=2000, each F_0=5, x_0={0, 0.02, 0.02, 0});
  equation
    connect(wall.flange, spring[1].flange_a);
    for i in 1:n loop
      connect(spring[i].flange_b, mass[i].flange_a);
      connect(mass[i].flange_b, spring[i + 1].flange_a);
      connect(mass[i].flange_b, guide[i].flange_a);
      connect(guide[i].flange_b, wall.flange);
    end for;
    connect(spring[n + 1].flange_b, wall.flange);
  end ThreeMasses;
end LibraryChains;
