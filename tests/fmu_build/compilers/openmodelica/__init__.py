"""The OpenModelica backend; only `test_real*` needs omc."""
