package OwnBase "A model that extends a class that is declared in itself"
  partial model Decaying
    Real x(start=1, fixed=true);
  end Decaying;

  model Model
    extends Base;
    partial model Base
      extends Decaying;
    equation
      der(x) = -x;
    end Base;
  end Model;
end OwnBase;
