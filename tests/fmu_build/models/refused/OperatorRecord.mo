package Numbers
  operator record Number // here
    Real re;
    Real im;
    encapsulated operator function '+'
      import Numbers.Number;
      input Number a;
      input Number b;
      output Number c;
    algorithm
      c := Number(a.re + b.re, a.im + b.im);
    end '+';
  end Number;
end Numbers;

model OperatorRecord "Complex numbers of one's own"
  Numbers.Number a(re=time, im=1), b(re=2, im=time), c;
equation
  c = a + b;
end OperatorRecord;
