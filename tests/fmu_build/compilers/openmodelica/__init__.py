"""The OpenModelica backend: what needs no omc, and in `test_real*` what does."""
