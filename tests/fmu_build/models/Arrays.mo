package Arrays "Vectors, matrices and loops"
  model Table "Piecewise-linear table by for-loops: each segment adds its change of slope beyond its breakpoint"
    parameter Integer n = 4 "Number of breakpoints";
    parameter Real x_i[n] = {0.1, 0.3, 0.6, 0.8} "Breakpoints";
    parameter Real k_i[n] = {5, 1, 10, 2} "Slope beyond each breakpoint";
    Real u;
    Real part[n] "Contribution of each breakpoint";
    Real y;
  equation
    u = 0.5 - 0.5*cos(time);
    part[1] = if u > x_i[1] then k_i[1]*(u - x_i[1]) else 0;
    for i in 2:n loop
      part[i] = if u > x_i[i] then (k_i[i] - k_i[i - 1])*(u - x_i[i]) else 0;
    end for;
    y = sum(part);
  end Table;

  model MatrixVector "A linear system as a matrix-vector product"
    parameter Real A[3, 3] = [-1, 2, 0; -2, -1, 1; 0, -1, -0.5];
    parameter Real b[3] = {1, 0, -1};
    Real x[3](start={1, 2, 3}, each fixed=true);
    Real norm "Squared length";
    Real total;
    Real quadratic "x' A' x";
    Real biggest;
  equation
    der(x) = A*x + b;
    norm = x*x;
    total = sum(x);
    quadratic = x*(transpose(A)*x);
    biggest = max(x);
  end MatrixVector;

  model Heat "A rod in n pieces, by loops"
    parameter Integer n = 8;
    parameter Real diffusivity = 0.1;
    Real T[n](each start=0, each fixed=true);
    Real mean;
  equation
    der(T[1]) = diffusivity*n*n*(T[2] - T[1]) + 1;
    for i in 2:n - 1 loop
      der(T[i]) = diffusivity*n*n*(T[i + 1] - 2*T[i] + T[i - 1]);
    end for;
    der(T[n]) = diffusivity*n*n*(T[n - 1] - T[n]);
    mean = sum(T)/n;
  end Heat;

  model Shapes "Matrices that are not square: transpose, concatenation, slices, fill, linspace, diagonal"
    parameter Real g = 3;
    Real A[2, 3];
    Real B[3, 2];
    Real C[2, 2];
    Real row[3], column[2], long[4];
    Real d[2, 2];
    Real t[3, 2] "Transpose of an expression";
    Real k[3];
    Real beside[2, 5] "Matrices side by side";
    Real r[5, 5] "A projection; the size is one that the compiler does not write out";
  equation
    A = [1, 2, time; 4, 5, 6];
    B = transpose(A);
    C = A*B;
    row = A[2, :];
    column = A[:, end];
    long = cat(1, {time, g}, fill(g*time, 2));
    d = diagonal({g, time});
    t = 2*transpose(A + [time, 0, 0; 0, 0, 1]);
    k = time*linspace(0, g, 3);
    beside = cat(2, A, d);
    r = identity(5) - outerProduct(g*(1:5), g*(1:5))/55;
  end Shapes;

  model Products "Outer and elementwise products, fill, slices"
    parameter Real a[3] = {1, 2, 3};
    Real c[3];
    Real M[2, 3];
    Real s;
    Real slice[2];
  equation
    c = time*a .* {2, 3, 4} + fill(1.0, 3);
    for i in 1:2 loop
      for j in 1:3 loop
        M[i, j] = i*c[j];
      end for;
    end for;
    s = sum(M[i, j] for i in 1:2, j in 1:3);
    slice = c[2:3];
  end Products;

  model Members "Members of some elements of an array of components, whole and one by one"
    model Part
      parameter Real k = 1;
      Real x[2];
    equation
      x = {k*time, k + 10};
    end Part;
    parameter Real k[3] = {1, 2, 5};
    Part parts[3](k=k);
    Real whole[2, 2];
    Real first[3];
    Real total;
  equation
    whole = parts[{3, 1}].x;
    first = {parts[i].x[1] for i in 1:3};
    total = sum(parts[2:3].k);
  end Members;
end Arrays;
