"""rumoca's terse messages are explained in Modelica's terms, with source positions."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import pytest

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.errors import BuildError, ModelicaError, UnsupportedModelError
from fmu_build.support.request import BuildRequest

_X = "Real x(start = 0, fixed = true);"
_N = "discrete Integer n(start = 0, fixed = true);"


@dataclass(frozen=True)
class Case:
    """Declarations (line 2) and equations (line 4) of a model M, and its message without the folder."""

    declarations: str
    equations: str
    error: type[BuildError]
    message: str


_WITH_ARGUMENT = (
    "partial function base input Real x; output Real y; end base; function g input base h; input Real x; "
    "output Real y; algorithm y := h(x); end g; "
)


def _function(body: str, local: str = "") -> str:
    return f"function f input Real x; output Real y; {local} algorithm {body} end f; Real y;"


_GATES = (
    "connector I = input Boolean; connector O = output Boolean; block S O y; equation y = time > 0.5; end S; "
    "block A I u[2]; O y; equation y = u[1] and u[2]; end A; "
)

_NET = (
    "connector P Real v; flow Real i; end P; model R P p; equation p.v = p.i; end R; "
    "model V P p; equation p.v = 6; end V;"
)

_RECORDS = (
    "record B Real x=1; Real y=1; end B; record I = B(x=3); "
    "function g input B a; output Real z; algorithm z:=a.x*100+a.y; end g;"
)

_CASES = {
    "slices of a list of elements": Case(
        "Real y[4];",
        "y[{1, 3}] = {time, 1}; y[2:2:4] = {3, 4};",
        UnsupportedModelError,
        "M.mo: unbalanced model: 3 equations, 4 unknowns, as the compiler counts them; it miscounts "
        "equations of slices with a list, a step or end as subscript: write them for each element, or for",
    ),
    "slices up to the end": Case(
        "parameter Real v[:] = {1, 2, 3, 4}; parameter Integer n = size(v, 1); Real y[n];",
        "y[1:2] = {time, 1}; y[3:end] = 2*v[3:end];",
        UnsupportedModelError,
        "M.mo:4:23: unbalanced model: 3 equations, 4 unknowns, as the compiler counts them; it miscounts",
    ),
    "change of an input": Case(
        "input Boolean b; Integer n(start=0, fixed=true);",
        "when change(b) then n = pre(n) + 1; end when;",
        UnsupportedModelError,
        "M.mo:2:3: change() of an input is not supported; give it to a variable, as in Boolean b = u, and "
        "write change(b)",
    ),
    "edge of an input": Case(
        "input Boolean b; Integer n(start=0, fixed=true);",
        "when edge(b) then n = pre(n) + 1; end when;",
        UnsupportedModelError,
        "M.mo:2:3: edge() of an input is not supported; give it to a variable",
    ),
    "pre of an input": Case(
        "input Integer k; Integer n(start=0, fixed=true);",
        "when k > pre(k) then n = pre(n) + 1; end when;",
        UnsupportedModelError,
        "M.mo:4:12: pre() of an input is not supported; declare Boolean b = k, or Integer, and write pre(b)",
    ),
    "an if-equation after a plain branch": Case(
        "Integer y(start=5, fixed=true);",
        "when time >= 0.5 then y = 2; elsewhen 2*time >= 1 then if pre(y) == 5 then y = 8; else y = 7; "
        "end if; end when;",
        UnsupportedModelError,
        "M.mo:4:41: an if-equation for y in an elsewhen is not supported after a branch that sets it without",
    ),
    "an algorithm section of two variables": Case(
        "Real y; Real z;",
        "algorithm z := time; y := z;",
        UnsupportedModelError,
        "M.mo:4:3: this algorithm section is not supported: outside of when-clauses one sets",
    ),
    "a state in an initial algorithm": Case(
        "Real x;",
        "der(x) = -x; initial algorithm x := 3;",
        UnsupportedModelError,
        "M.mo:4:34: an initial algorithm can set discrete variables and parameters with fixed = false; write",
    ),
    "two samples in one condition": Case(
        _N,
        "when {sample(0, 0.2), sample(0.1, 0.5)} then n = pre(n) + 1; end when;",
        UnsupportedModelError,
        "M.mo:4:3: a when-clause with several sample() in its condition is not supported",
    ),
    "a condition that reads what its clause sets": Case(
        "discrete Real level(start=1, fixed=true);",
        "when time > level then level = pre(level) + 1; end when;",
        UnsupportedModelError,
        "M.mo:4:8: the condition of a when-clause reads level, which the clause sets; write pre(level)",
    ),
    "such a condition in an algorithm": Case(
        "discrete Real level(start=1, fixed=true);",
        "algorithm when {time > 7, time > level} then level := pre(level) + 1; end when;",
        UnsupportedModelError,
        "the condition of a when-clause reads level, which the clause sets; write pre(level)",
    ),
    "such a condition of an Integer in an algorithm": Case(
        "Integer n(start=1, fixed=true);",
        "algorithm when time > n then n := pre(n) + 1; end when;",
        UnsupportedModelError,
        "M.mo:4:3: an algorithm section reads the value of a discrete variable before the assignment",
    ),
    "an iterator in a when-clause": Case(
        "discrete Real d[3];",
        "when time > 0.5 then d = {i*time for i in 1:3}; end when;",
        UnsupportedModelError,
        "M.mo:4:28: an array comprehension, or a sum() or the like with an iterator, is not supported",
    ),
    "one of several results in the expression of a parameter": Case(
        "function f input Real x; output Real a; output Real b; algorithm a := x; b := 2*x; end f; "
        "parameter Real p = f(3) + 1;",
        "",
        UnsupportedModelError,
        "M.mo:2:93: the value of the parameter p is not supported: a function with several results",
    ),
    "several results in a loop of a function": Case(
        "function g input Real x; output Real a; output Real b; algorithm a := x; b := 2*x; end g; "
        + _function(
            "y := 0; for i in 1:3 loop (u, v) := g(i*x); y := y + u + v; end for;",
            "protected Real u; Real v;",
        ),
        "y = f(time);",
        UnsupportedModelError,
        "a loop of a function sets a variable that has no value before the loop; give it one",
    ),
    "a record that inherits with modifiers, constructed as an argument": Case(
        f"{_RECORDS} Real y = g(I(y=7));",
        "",
        UnsupportedModelError,
        "I() would have the values of the record that I inherits, unless it is the whole value of",
    ),
    "such a record as a variable of a function": Case(
        f"{_RECORDS} function h input Real x; output Real z; protected I r; algorithm z:=r.x+x; end h; "
        "Real y = h(time);",
        "",
        UnsupportedModelError,
        "the modifiers of the record r of the function h, or of its class, would be lost; assign its members",
    ),
    "modifiers of a record of a function": Case(
        f"{_RECORDS} function h input Real x; output B r(x=2); algorithm r.y:=x; end h; B y = h(time);",
        "",
        UnsupportedModelError,
        "the modifiers of the record r of the function h, or of its class, would be lost; assign its members",
    ),
    "arguments of a function that inherits late": Case(
        "partial function p input Real b; output Real y; end p; function f input Real a; extends p; "
        "algorithm y:=10*a+b; end f; Real z = f(1, time);",
        "",
        UnsupportedModelError,
        "the arguments of f(...): the inherited ones would come first",
    ),
    "arguments of a record with a final member": Case(
        "record R Real a=1; final parameter Real k=9; Real b=3; end R; R r = R(5, 2);",
        "",
        UnsupportedModelError,
        "the arguments of R(...): its final and constant members would count too; name the arg",
    ),
    "a column in connect()": Case(
        "connector I=input Real; connector O=output Real; block S O y[2,2]={{1,2},{3,4}}; end S; "
        "block T I u[2]; O y=u[1]; end T; S s; T t;",
        "connect(s.y[:, 2], t.u);",
        UnsupportedModelError,
        "M.mo:4:3: a column of a matrix in connect() is not supported",
    ),
    "a class extended as it is redeclared, in a model": Case(
        "model B replaceable model X parameter Real k=5; end X; X x; end B; "
        "model C extends B; redeclare model extends X end X; end C; C b;",
        "",
        UnsupportedModelError,
        "M.mo:2:89: redeclare ... extends in a model is not supported; give the new class a name of its own",
    ),
    "a function extended as it is redeclared, in a model": Case(
        "model B replaceable function f input Real x; output Real y; algorithm y := x; end f; Real y = f(1); "
        "end B; model C extends B; redeclare function extends f algorithm y := 2*x; end f; end C; C b;",
        "",
        UnsupportedModelError,
        "redeclare ... extends in a model is not supported; give the new class a name of its own",
    ),
    "a name with a quotation mark": Case(
        "parameter Real 'a\"b' = 3;",
        "",
        UnsupportedModelError,
        "M.mo:2:18: the name 'a\"b' has a quotation mark, which is not supported",
    ),
    "a subscript in connect() that is not evaluated": Case(
        f"{_NET} R r[3]; V v;",
        "connect(v.p, r[end].p);",
        UnsupportedModelError,
        "M.mo:4:3: the subscript [end] in connect() would be ignored, because the compiler cannot evaluate",
    ),
    "a constant of a package as a subscript": Case(
        f"{_NET} package C constant Integer k = 2; end C; R r[3]; V v;",
        "for i in 1:2 loop connect(v.p, r[C.k].p); end for;",
        UnsupportedModelError,
        "M.mo:4:21: the subscript [C.k] in connect() would be ignored, because the compiler cannot evaluate",
    ),
    "a condition of a connection that is not evaluated": Case(
        f"{_NET} parameter Boolean u[2] = {{true, false}}; R r; V v;",
        "if u[2] then connect(v.p, r.p); end if;",
        UnsupportedModelError,
        "M.mo:4:3: the condition u[2] of a connection would be ignored, because the compiler cannot evaluate",
    ),
    "a condition of a component with a namesake": Case(
        "model A parameter Integer n = 2; end A; parameter Integer n = 3; A a; Real x if a.n == 2;",
        "",
        UnsupportedModelError,
        "M.mo:2:80: n in the condition a.n == 2 would be that of the class; rename it",
    ),
    "a class redeclared by one of its name": Case(
        "model Y parameter Real k=1; end Y; model Z extends Y(k=4); end Z; model B replaceable model X=Y; "
        "X x; end B; model T replaceable model X=Z; B b(redeclare model X=X); end T; T t;",
        "",
        UnsupportedModelError,
        "the class would be redeclared as its own default; give the new one another name",
    ),
    "the same, final": Case(
        "model Y parameter Real k=1; end Y; model Z extends Y(k=4); end Z; model B replaceable model X=Y; "
        "X x; end B; model T replaceable model X=Z; B b(redeclare final model X=X); end T; T t;",
        "",
        UnsupportedModelError,
        "the class would be redeclared as its own default; give the new one another name",
    ),
    "a name in the modifiers of a short class": Case(
        "constant Real p=3; model Y parameter Real p=1; parameter Real k=2; end Y; model X = Y(k=p); X x;",
        "",
        UnsupportedModelError,
        "p in the modifiers of the short class X would be that of Y; write a class that extends it",
    ),
    "a sum over a matrix of components": Case(
        "model A parameter Real k=1; end A; A a[2,2](k={{1,2},{3,4}}); Real y = sum(a.k);",
        "",
        UnsupportedModelError,
        "M.mo:2:74: a sum or the like over a matrix of components is not supported",
    ),
    "a global name beside another": Case(
        "package X constant Real c=5; end X; Real y = .X.c;",
        "",
        UnsupportedModelError,
        "the leading dot of .X is lost, and it is not the only X; import it",
    ),
    "an element as the condition of a component": Case(
        "parameter Boolean u[2] = {true, false}; Real y if u[1];",
        "",
        UnsupportedModelError,
        "M.mo:2:48: the condition of y is not evaluated; supported are parameters of the model and of its",
    ),
    "a function of the iterator of a sum": Case(
        _function("y := 2*x;") + " Real z = sum(f(i*time) for i in 1:3);",
        "y = z;",
        UnsupportedModelError,
        "M.mo:2:88: a function of i inside of a sum, product, max or min over i is not supported",
    ),
    "a constant record of a package": Case(
        "record R Real a = 4; end R; package P constant R r(a = 7); end P; Real y = P.r.a;",
        "",
        UnsupportedModelError,
        "M.mo:2:41: P.r.a: members of a record that is a constant of a package are not supported",
    ),
    "an index that is out of its array in one branch": Case(
        "Real x[3](each start = 0, each fixed = true);",
        "for i in 1:3 loop der(x[i]) = if i == 1 then 1 else x[i - 1]; end for;",
        UnsupportedModelError,
        "M.mo: the index 0 is outside of 1 to 3, if only in a branch that is never taken",
    ),
    "reinit of an element": Case(
        "Real x[2](each start = 0, each fixed = true);",
        "der(x[1]) = 1; der(x[2]) = 1; when time > 0.5 then reinit(x[2], 5); end when;",
        UnsupportedModelError,
        "M.mo:4:54: reinit() of single elements of an array is not supported; write reinit(x, {...}) for the",
    ),
    "a parameter that a function of an array gives": Case(
        "function f input Real x[2]; output Real y; algorithm y := x[1] + x[2]; end f; "
        "parameter Real v[2] = {1, 2}; parameter Real k = f(v); Real s(start = 1, fixed = true);",
        "der(s) = -k;",
        UnsupportedModelError,
        "M.mo:2:111: unbalanced model: 2 equations, 1 unknowns, as the compiler counts them; it miscounts",
    ),
    "elements of a constant as subscripts in connect()": Case(
        "connector O = output Real; connector I = input Real; model S O y = 1; end S; "
        "model B I u[3]; end B; S s[3]; B b; constant Integer p[3] = {3, 1, 2};",
        "for i in 1:3 loop connect(s[p[i]].y, b.u[i]); end for;",
        UnsupportedModelError,
        "M.mo:4:21: unbalanced model: 3 equations, 6 unknowns, as the compiler counts them; it miscounts",
    ),
    "the same of a connector": Case(
        "connector O = output Real; connector I = input Real; model A O y[3] = {1, 2, 3}; end A; "
        "model B I u[3]; end B; A a; B b; constant Integer p[3] = {3, 1, 2};",
        "for i in 1:3 loop connect(a.y[p[i]], b.u[i]); end for;",
        UnsupportedModelError,
        "M.mo:4:21: this subscript in connect() is not supported; write numbers, a range of numbers",
    ),
    "a falling range in connect()": Case(
        "connector O = output Real; connector I = input Real; model S O y = 1; end S; "
        "model B I u[3]; end B; S s[3]; B b;",
        "connect(s.y, b.u[3:-1:1]);",
        UnsupportedModelError,
        "M.mo:4:3: unbalanced model: ",
    ),
    "a loop over a discrete array": Case(
        "Real x(start = 0, fixed = true); Integer b[3];",
        "der(x) = 1; for i in 1:3 loop b[i] = integer(i*time); end for;",
        UnsupportedModelError,
        "M.mo: a for-loop over the elements of a discrete array outside a when-clause is not supported",
    ),
    "div() by a variable": Case(
        "Real x(start = 1, fixed = true), y(start = 0.4, fixed = true), a;",
        "der(x) = 1; der(y) = 0.3; a = div(x, y);",
        UnsupportedModelError,
        "M.mo:4:33: div() with a divisor that changes is not supported; express it by floor(x/y)",
    ),
    "an end in a subscript of connect()": Case(
        "connector O = output Real; connector I = input Real; model A O y[3] = {1, 2, 3}; end A; "
        "model B I u[2]; end B; A a; B b;",
        "connect(a.y[2:end], b.u);",
        UnsupportedModelError,
        "M.mo:4:3: this subscript in connect() is not supported; write numbers, a range of numbers",
    ),
    "a sum of very many terms": Case(
        "Real x;",
        f"x = {' + '.join(f'{i}*sin({i}*time)' for i in range(600))};",
        UnsupportedModelError,
        "M.mo: an expression of M is nested too deep, such as a sum of several hundred terms; use sum()",
    ),
    "a loop of a function that starts at a variable": Case(
        "function f input Real A[:, :]; output Real x; protected Real B[size(A, 1), size(A, 2)]; "
        "algorithm B := A; "
        "for k in 1:1 loop for i in k + 1:2 loop B[i, k] := B[i, k]/B[k, k]; end for; end for; "
        "x := B[2, 1]; end f; Real y;",
        "y = f({{4 + time, 1}, {1, 3}});",
        UnsupportedModelError,
        "a loop that sets elements of an array starts at a number; write for i in 1:n",
    ),
    "a capacitance of zero": Case(
        "parameter Real C = 0; Real v(start = 1, fixed = true), u(start = 2, fixed = true); Real i;",
        "i = C*(der(v) - der(u)); i = -v; der(u) = i - u;",
        UnsupportedModelError,
        "M.mo: the factor of a der(...) is zero, or not finite, with the values of its parameters",
    ),
    "a function as an argument without parentheses": Case(
        _WITH_ARGUMENT + "function f extends base; algorithm y := 2*x; end f; Real y;",
        "y = g(f, time);",
        UnsupportedModelError,
        "M.mo:2:146: a function as an argument is supported only as function f()",
    ),
    "a function as an argument that does not extend": Case(
        _WITH_ARGUMENT + "function f input Real x; output Real y; algorithm y := 2*x; end f; Real y;",
        "y = g(function f(), time);",
        UnsupportedModelError,
        "M.mo:4:9: the function f as an argument is supported only if it extends M.base, which is partial",
    ),
    "sign() in a sum that an Integer equals": Case(
        "Integer n;",
        "n = integer(3*time) + sign(time - 0.5);",
        UnsupportedModelError,
        "M.mo:2:3: sign() has a Real value here, which an Integer does not take; write integer(sign(...))",
    ),
    "the derivative of the last element": Case(
        "Real T[3](each start = 1, each fixed = true);",
        "der(T[1]) = 1; der(T[2]) = 2; der(T[end]) = 3;",
        UnsupportedModelError,
        "M.mo:4:33: der(T[end]) is not supported; write the number of the element",
    ),
    "reinit() in an elsewhen alone": Case(
        _X + _N,
        "der(x) = 1; when x > 1 then n = 1; elsewhen x > 2 then n = 2; reinit(x, 5); end when;",
        UnsupportedModelError,
        "M.mo:4:47: reinit(), assert() and terminate() in an elsewhen are supported only if",
    ),
    "reinit() of another variable": Case(
        _X + "Real z(start = 1, fixed = true);" + _N,
        "der(x) = 1; der(z) = 0; when x > 1 then n = 1; reinit(z, 1); elsewhen "
        "x > 2 then n = 2; reinit(x, 5); end when;",
        UnsupportedModelError,
        "M.mo:4:73: reinit(), assert() and terminate() in an elsewhen are supported only if",
    ),
    "terminate() in an elsewhen": Case(
        _X + _N,
        'der(x) = 1; when x > 1 then n = 1; elsewhen x > 2 then n = 2; terminate("end"); end when;',
        UnsupportedModelError,
        "M.mo:4:47: reinit(), assert() and terminate() in an elsewhen are supported only if",
    ),
    "assert() in an elsewhen": Case(
        _X + _N,
        'der(x) = 1; when x > 1 then n = 1; elsewhen x > 2 then n = 2; assert(x < 9, "a"); end when;',
        UnsupportedModelError,
        "M.mo:4:47: reinit(), assert() and terminate() in an elsewhen are supported only if",
    ),
    "an Integer that equals sign()": Case(
        "Integer s;",
        "s = sign(time - 0.5);",
        UnsupportedModelError,
        "M.mo:2:3: sign() has a Real value here, which an Integer does not take; write integer(sign(...))",
    ),
    "a matrix for the arrays of an array of components": Case(
        "model A parameter Real g[2]; Real y = g[1] + g[2]; end A; A b[2](g = [1, 2; 3, 4]);",
        "",
        UnsupportedModelError,
        "M.mo:2:63: the elements of an array of components take arrays from a literal of braces only",
    ),
    "an array parameter for the arrays of an array of components": Case(
        "model A parameter Real g[2] = {5, 6}; Real y = g[1] + g[2]; end A; "
        "parameter Real G[2, 2] = [1, 2; 3, 4]; A b[2](g = G);",
        "",
        UnsupportedModelError,
        "M.mo: an array parameter cannot give each element of an array of components an array of its own",
    ),
    "an array of records": Case(
        "record R Real a; Real b; end R; R r[2];",
        "r = {R(time, 2), R(3, 4)};",
        UnsupportedModelError,
        "M.mo:4:3: an equation for the whole array of records r is not supported; write one for each element",
    ),
    "an if-expression of records": Case(
        "record R Real a; Real b; end R; R r;",
        "r = if time > 0.5 then R(1, 2) else R(3, 4);",
        UnsupportedModelError,
        "M.mo:2:35: unbalanced model: 1 equations, 2 unknowns, as the compiler counts them; it miscounts",
    ),
    "an if-equation of records": Case(
        "record R Real a; Real b; end R; R r;",
        "if time > 0.5 then r = R(1, 2); else r = R(3, 4); end if;",
        UnsupportedModelError,
        "M.mo:2:35: unbalanced model: 1 equations, 2 unknowns, as the compiler counts them; it miscounts",
    ),
    "results for the elements of an array": Case(
        "function f input Real x; output Real y; output Real z; algorithm y := x; z := x; end f; Real w[2];",
        "(w[1], w[2]) = f(time);",
        UnsupportedModelError,
        "M.mo:4:3: elements of arrays cannot take the results of a function; give these to variables first",
    ),
    "results of a function in a when-clause": Case(
        "function f input Real x; output Real y; output Real z; algorithm y := x; z := x; end f; "
        "discrete Real v; discrete Real w;",
        "when sample(0, 0.2) then (v, w) = f(time); end when;",
        UnsupportedModelError,
        "M.mo:4:28: taking several results of a function is not supported in a when-clause; write a function",
    ),
    "a sampled variable that depends on itself": Case(
        "discrete Real d(start = 1, fixed = true); Real y = time + d;",
        "when sample(0.1, 0.1) then d = 2*y; end when;",
        UnsupportedModelError,
        "M.mo:2:12: the when-clause that sets d reads y, which depends on d at the same instant",
    ),
    "a loop without a range": Case(
        "Real a[3];",
        "for i loop a[i] = i*time; end for;",
        UnsupportedModelError,
        "M.mo:4:3: a for-loop needs a range here, as in for i in 1:n",
    ),
    "end in a function": Case(
        "function f input Real x[3]; output Real v[3]; algorithm for i in 1:3 loop v[end + 1 - i] := x[i]; "
        "end for; end f; Real y[3] = f({time, 1, 2});",
        "",
        UnsupportedModelError,
        "M.mo:2:78: end is not supported in this subscript; write the size of the array, size(v, 1)",
    ),
    "members that connections add to a bus": Case(
        "connector In = input Real; connector Out = output Real; expandable connector Bus end Bus; "
        "model A Out y = time; end A; model B In u; end B; A a; B b; Bus bus;",
        "connect(a.y, bus.s); connect(bus.s, b.u);",
        UnsupportedModelError,
        "M.mo:2:59: connections give this expandable connector members that it does not declare",
    ),
    "a clock": Case(
        "Real u = time; Real y;",
        "y = sample(u, Clock(0.1));",
        UnsupportedModelError,
        "M.mo:4:17: clocks are not supported; write when sample(start, period) then",
    ),
    "a redeclaration as an element": Case(
        "package P model D parameter Real c = 1; Real y = c*time; end D; model E extends D; end E; "
        "model H replaceable D d; end H; model X extends H; redeclare E d(c = 5); end X; end P; extends P.X;",
        "",
        UnsupportedModelError,
        "M.mo:2:144: this redeclaration of an inherited component is not supported as an element of a class",
    ),
    "a reduction in a constant": Case(
        "package P constant Real T[3] = {1, 2, 3}; constant Real S = sum(T); end P; Real y = P.S;",
        "",
        UnsupportedModelError,
        "M.mo:2:45: sum() in the value of a constant is not supported; write the value",
    ),
    "redeclared by a class of its own with the same members": Case(
        "model A Real z = time; end A; model B Real z = 2*time; end B; "
        "model C replaceable A a; end C; C c(redeclare B a);",
        "",
        UnsupportedModelError,
        "M.mo:2:101: M.B cannot replace M.A: supported are classes that extend the one that they replace",
    ),
    "edge of an expression": Case(
        _X + _N,
        "der(x) = 1; when edge(x > 0.5) then n = 1; end when;",
        ModelicaError,
        "M.mo:4:20: edge(x > 0.5): edge() applies to variables, not to expressions",
    ),
    "pre of an expression": Case(
        _X + _N,
        "der(x) = 1; when x > 0.5 then n = pre(n + 1); end when;",
        ModelicaError,
        "M.mo:4:37: pre(n + 1): pre() applies to variables",
    ),
    "pre of a continuous variable": Case(
        _X + "Real y;",
        "der(x) = 1; y = pre(x);",
        ModelicaError,
        "M.mo:4:19: pre(x): pre() of the continuous variable x",
    ),
    "reinit of an algebraic variable": Case(
        _X + "Real y;",
        "der(x) = 1; y = x; when x > 0.5 then reinit(y, 0); end when;",
        ModelicaError,
        "M.mo:4:40: reinit(y, 0): reinit() can be applied to states only: y is not a state",
    ),
    "assigned in two when-clauses": Case(
        _X + "discrete Real d;",
        "der(x) = 1; when x > 0.5 then d = 1; end when; when x > 0.6 then d = 2; end when;",
        ModelicaError,
        "M.mo: a discrete variable is assigned in two when-clauses (model M)",
    ),
    "different numbers of equations": Case(
        _X + "Real y;",
        "der(x) = 1; if x > 0.5 then y = 1; y = 2; else y = 3; end if;",
        ModelicaError,
        "M.mo: the branches of an if-equation have different numbers of equations (model M)",
    ),
    "division of a constant by zero": Case(
        "constant Real q = 1/0; Real y;",
        "y = q;",
        ModelicaError,
        "M.mo:2:17: the value of q is divided by zero",
    ),
    "two equations too many": Case(
        "Real y;",
        "y = 1; y = 2; y = 3;",
        ModelicaError,
        "M.mo: unbalanced model: 3 equations, 1 unknowns (model M)",
    ),
    "slices of an array of components": Case(
        "block U input Real u; Real y = 2*u; end U; U u[3];",
        "u[1].u = time; u[2:3].u = u[1:2].y;",
        UnsupportedModelError,
        "M.mo: unbalanced model: 5 equations, 6 unknowns, as the compiler counts them; it miscounts "
        "equations of slices of arrays of components",
    ),
    "each with an array": Case(
        "block V parameter Real k = 1; Real x(start = k, fixed = true); equation der(x) = k; end V; "
        "block W V v[2]; end W; W w[2](each v(k = {7, 8}));",
        "",
        UnsupportedModelError,
        "M.mo:2:124: unbalanced model: 8 equations, 4 unknowns, as the compiler counts them",
    ),
    "type error that has brackets": Case(
        "Real a[3]; Real b[2];",
        "a = {1, 2, 3}; b = a;",
        ModelicaError,
        "M.mo:4:18: array dimension mismatch: expected `[2]`, found `[3]`",
    ),
    "two derivatives of expressions": Case(
        _X + "Real y, z;",
        "der(x) = 1; y = der(2*x); z = der(x*x);",
        UnsupportedModelError,
        "M.mo: der(...): der() is supported for variables, not for expressions or members of the elements of "
        "an array; differentiate a variable that is equal to it (model M; see M.mo:4:19, M.mo:4:33)",
    ),
    "break": Case(
        _function("y := 0; for i in 1:3 loop y := y + x; if y > 2 then break; end if; end for;"),
        "y = f(time);",
        UnsupportedModelError,
        "M.mo:2:3: the function f has a statement that is not supported, such as a break",
    ),
    "while on what is computed": Case(
        _function("y := 1; while abs(y*y - x) > 1e-6 loop y := 0.5*(y + x/y); end while;"),
        "y = f(time + 1);",
        UnsupportedModelError,
        "M.mo:2:3: the function f has a statement that is not supported",
    ),
    "algorithm section": Case(
        _X + "Real y, z;",
        "der(x) = 1; algorithm y := x; z := y; y := 2*y;",
        UnsupportedModelError,
        "M.mo:4:15: this algorithm section is not supported",
    ),
    "two samplers in one when-clause": Case(
        _N,
        "when sample(0, 1) then n = 1; elsewhen sample(0, 2) then n = 2; end when;",
        UnsupportedModelError,
        "M.mo:4:33: elsewhen sample(0, 2): a when-clause that has sample() in one branch",
    ),
    "sampler as a variable in one branch": Case(
        _X + _N + "Boolean t;",
        "der(x) = 1; t = sample(0, 1); when x > 0.5 then n = 1; elsewhen t then n = 2; end when;",
        UnsupportedModelError,
        "M.mo: a when-clause with sample() beside another condition is not supported (model M)",
    ),
    "sampler and another condition of a discrete Real": Case(
        "discrete Real d(start=0, fixed=true);",
        "when sample(0, 1) then d = pre(d) + 1; elsewhen time > 3 then d = 5; end when;",
        UnsupportedModelError,
        "M.mo:4:8: sample() in one of several branches of a when-clause is not supported",
    ),
    "conditions of an if-equation from two samplers": Case(
        "Boolean a(start=false, fixed=true); Boolean b(start=false, fixed=true); Real s = sin(time); "
        "discrete Real d(start=0, fixed=true);",
        "when sample(0, 0.25) then a = s > 0.2; end when; when sample(0.25, 0.25) then "
        "if pre(d) > 1 then b = s > 0.3; d = s; elseif a then b = s > 0.4; d = 2*s; "
        "else b = s > 0.5; d = 3*s; end if; end when;",
        UnsupportedModelError,
        "M.mo:4:57: an if-equation in a when-clause with sample() is not supported if its conditions combine",
    ),
    "a list of indices that end gives": Case(
        "Real v[3] = {time, 2*time, 3}; Real y;",
        "y = time*sum(v[{end, 2}]);",
        UnsupportedModelError,
        "M.mo: elements that a list of indices selects, as v[{1, 3}], are not supported in this place",
    ),
    "one sampler twice in a condition": Case(
        _X,
        "der(x) = 1; when {sample(0.5, 0.5), sample(0.5, 0.5)} then reinit(x, 0); end when;",
        UnsupportedModelError,
        "M.mo:4:21: a when-clause with several sample() in its condition is not supported",
    ),
    "pre() of a parameter that is not fixed": Case(
        "parameter Integer n0(fixed=false); Integer n;",
        "when time > 0.5 then n = pre(n) + 1; end when; initial equation n0 = 7; pre(n) = n0;",
        UnsupportedModelError,
        "M.mo:4:75: pre(...) of a parameter with fixed = false, as an initial equation, is not supported",
    ),
    "recursive function": Case(
        _function("y := if x <= 0 then 1 else x*f(x - 1);"),
        "y = f(time);",
        UnsupportedModelError,
        "M.mo:2:12: the recursive function f is not supported",
    ),
    "elements of an array in a when-clause": Case(
        "Integer n[2](each start = 0, each fixed = true);",
        "when time > 0.5 then n[1] = 1; n[2] = 2; end when;",
        UnsupportedModelError,
        "M.mo: a when-clause that sets single elements of the array n is not supported; set the whole array, "
        "or declare an array of a model with the clause (model M; see M.mo:4:24, M.mo:4:34)",
    ),
    "edge of an element in a loop": Case(
        "Boolean b[2]; Integer n[2](each start = 0, each fixed = true);",
        "for i in 1:2 loop b[i] = sin(i*time) > 0.5; when edge(b[i]) then n[i] = 1; end when; end for;",
        UnsupportedModelError,
        "M.mo:4:52: edge(b[i]): edge(), change() and pre() of what depends on the variable of a for-loop",
    ),
    "two clauses that reinitialize": Case(
        _X,
        "der(x) = 1; when x > 1 then reinit(x, 0); end when; when time > 5 then reinit(x, 2); end when;",
        ModelicaError,
        "M.mo: reinit(...): two when-clauses reinitialize one variable; the branches of one clause may, with "
        "elsewhen (model M; see M.mo:4:31, M.mo:4:74)",
    ),
    "last result left out": Case(
        "function f input Real x; output Real a; output Real b; algorithm a := x; b := 2; end f; "
        "function g input Real x; output Real a; output Real b; output Real c; "
        "algorithm (a, b) := f(x); c := 3; end g; Real u, v;",
        "(u, v) = g(time);",
        UnsupportedModelError,
        "M.mo:4:3: 2 of the 3 results of g are taken, which is not supported; assign each to a variable",
    ),
    "function of the language without a translation": Case(
        "Real w[2, 2];",
        "w = symmetric([1, time; 3, 4]);",
        UnsupportedModelError,
        "M.mo:4:7: symmetric() is not supported",
    ),
    "number of an enumeration": Case(
        "type E = enumeration(a, b); E e(start = E.a, fixed = true); Integer n;",
        "when time > 0.5 then e = E.b; end when; n = Integer(e);",
        UnsupportedModelError,
        "M.mo:4:47: Integer(e): Integer() of an enumeration that is not a parameter is not supported",
    ),
    "derivatives that equations determine together": Case(
        _X + "Real y(start = 0, fixed = true);",
        "der(x) + der(y) = 1; der(x) - der(y) = 2*time;",
        UnsupportedModelError,
        "M.mo:4:24: equations that determine several derivatives together",
    ),
    "loop of discrete equations": Case(
        "discrete Real a(start = 1, fixed = true), b(start = 0.5, fixed = true);",
        "when sample(0, 0.1) then a = pre(a) + b; b = 0.5*pre(b) + 0.25*a; end when;",
        UnsupportedModelError,
        "M.mo: discrete variables that depend on each other at the same instant are not supported",
    ),
    "two functions that call each other": Case(
        "function f input Real x; output Real y; algorithm y := if x < 0 then 0 else g(x - 1); end f; "
        "function g input Real x; output Real y; algorithm y := f(x); end g; Real y;",
        "y = f(time);",
        UnsupportedModelError,
        "M.mo: functions that call each other in turn are not supported",
    ),
    "Integer function that calls itself": Case(
        "function f input Integer n; output Integer r; algorithm r := if n < 2 then 1 else n*f(n - 1); "
        "end f; Integer y;",
        "y = f(5) + integer(time);",
        UnsupportedModelError,
        "M.mo:2:12: the recursive function f is not supported",
    ),
    "String in an equation": Case(
        'parameter String s = "a"; Real y;',
        'y = if s == "a" then time else 2;',
        UnsupportedModelError,
        "M.mo: Strings in equations are not supported",
    ),
    "loop through an argument without an effect": Case(
        "function f input Real u; input Real v; output Real y; algorithm y := sin(v); end f; Real q, r;",
        "q = f(r, time); r = q + 1;",
        UnsupportedModelError,
        "M.mo: an algebraic loop for q, r that only leads through arguments of functions without an effect",
    ),
    "power of a matrix": Case(
        "Real w[2, 2];",
        "w = [time, 1; 2, 3]^2;",
        UnsupportedModelError,
        "M.mo: powers of matrices are not supported; write A*A for A^2",
    ),
    "derivative of an input through a variable": Case(
        "input Real u; Real w; Real y;",
        "w = 2*u; y = der(w);",
        UnsupportedModelError,
        "M.mo: only 1 of 2 equations determine an unknown of their own: some repeat or contradict others, or "
        "the derivative of an input or of a function is needed (model M)",
    ),
    "maximum that varies": Case(
        "Real x(start = 0, fixed = true, max = y); Real y = time;",
        "der(x) = 1;",
        UnsupportedModelError,
        "M.mo:2:41: max of x depends on y, which is not a parameter",
    ),
    "one of two parameters undetermined": Case(
        _X + "parameter Real p[2](each fixed = false); initial equation p[1] = 3;",
        "der(x) = p[1] + p[2];",
        UnsupportedModelError,
        "M.mo:2:45: the parameter p[2] has fixed = false, and no initial equation determines it",
    ),
    "elements reinitialized in a loop": Case(
        "Real x[3](each start = 1, each fixed = true);",
        "der(x) = -x; when time > 0.5 then for i in 1:3 loop reinit(x[i], i); end for; end when;",
        UnsupportedModelError,
        "M.mo:4:55: reinit() of single elements of an array is not supported; write reinit(x, {...}) for the",
    ),
    "discrete variable of two when-clauses": Case(
        _N,
        "when time > 1 then n = pre(n) + 1; end when; when time > 2 then n = 0; end when;",
        ModelicaError,
        "M.mo: the discrete variable n is determined more than once, as by two when-clauses; an equation "
        "that determines another variable by it has that variable on the left: x = n (model M; see "
        "M.mo:4:22, M.mo:4:67)",
    ),
    "outer variable": Case(
        "model U outer Real v; Real y = 2*v; end U; inner Real v; U u;",
        "v = time;",
        UnsupportedModelError,
        "M.mo:2:11: outer variables that are neither parameters nor components are not supported",
    ),
    "two iterators of an array": Case(
        "Real a[2, 3];",
        "a = {i + 10*j*time for j in 1:3, i in 1:2};",
        UnsupportedModelError,
        "M.mo:4:7: the size of an array does not fit, or the compiler does not find it; write the array out",
    ),
    "an array of another size": Case(
        "Real a[2] = {1, 2, 3};",
        "",
        UnsupportedModelError,
        "M.mo: the size of an array does not fit",
    ),
    "Integer beside Real": Case(
        "Real a[3];",
        "a = cross({1, time, 3}, {4, 5, 6});",
        UnsupportedModelError,
        "M.mo:4:7: Integer values are not converted to Real in every place; write 1.0 for 1",
    ),
    "sum over nothing": Case(
        "Real y;",
        "y = time + sum(i*time for i in 1:0);",
        UnsupportedModelError,
        "M.mo:4:31: sums, products and arrays over an empty range are not supported",
    ),
    "iterator over an array": Case(
        "Real y;",
        "y = sum(i*time for i in {3, 1, 2});",
        UnsupportedModelError,
        "M.mo:4:24: ranges have whole numbers, as 1:n; iterators over arrays and enumerations",
    ),
    "range with a step": Case(
        "Real a[5];",
        "a = time*(0:0.5:2);",
        UnsupportedModelError,
        "M.mo: ranges have whole numbers, as 1:n;",
    ),
    "class of a base class": Case(
        "package A model T Real y = time; end T; end A; package B extends A; end B; B.T t;",
        "",
        UnsupportedModelError,
        "M.mo:2:50: B.T: an inherited class is found only where it is declared",
    ),
    "function of a medium in a function": Case(
        "package A function h input Real x; output Real y; algorithm y := x; end h; end A; "
        "function f replaceable package P = A; input Real x; output Real y; algorithm y := P.h(x); end f; "
        "function g = f(redeclare package P = A); Real y;",
        "y = g(time);",
        UnsupportedModelError,
        "M.mo:2:197: which function is called through a redeclared class is not clear here",
    ),
    "size of a local array": Case(
        "function f input Real a[:]; output Real y; protected Real b[size(a, 1)]; Integer n = size(b, 1); "
        "algorithm b := a; y := n*sum(b); end f; Real y;",
        "y = f({time, 1});",
        UnsupportedModelError,
        "M.mo:2:86: a function takes the size of a local array for the value of another local variable",
    ),
    "String as an argument": Case(
        'function f input Real x; input String s = "a"; output Real y; '
        'algorithm y := if s == "a" then x else 2*x; end f; Real y;',
        "y = f(time);",
        UnsupportedModelError,
        "M.mo:2:34: the argument s of f, a String, is not supported",
    ),
    "enumeration literal like a variable": Case(
        "package A type E = enumeration(x, y); end A; A.E e = A.E.y; Real y = if e == A.E.y then 1 else 0;",
        "",
        UnsupportedModelError,
        "M.mo:2:13: a literal of an enumeration is taken for a variable of the same name; rename one of them",
    ),
    "class that no base class has": Case(
        "package A model T Real y = 1; end T; end A; package B model U Real y = 1; end U; end B; B.T t;",
        "",
        ModelicaError,
        "M.mo:2:91: unresolved type reference: 'B.T'",
    ),
    "argument that a function does not have": Case(
        "model A parameter Real k = 1; end A; model B extends A(k = 2); end B; B b; "
        "function f input Real x; output Real y; algorithm y := x; end f; Real y;",
        "y = f(time, q = 3);",
        UnsupportedModelError,
        "M.mo: invalid call of function `f`: named argument `q` does not match any input",
    ),
    "a constant of a base function": Case(
        "function f input Real x; output Real y; protected constant Real k = 1; algorithm y := k*x; end f; "
        "function g extends f(k = 3); end g; Real y;",
        "y = g(time);",
        UnsupportedModelError,
        "M.mo:2:112: the base class of a function is given a value for k, which is no input",
    ),
    "a local variable before its value": Case(
        "function f input Real x; output Real y = x*h; protected Real h = 3; algorithm end f; Real y;",
        "y = f(time);",
        UnsupportedModelError,
        "M.mo:2:3: a function gives one of its variables a value by another one that is declared after it",
    ),
    "a loop over a list in a function": Case(
        _function("y := 0; for i in {1, 4} loop y := y + i*x; end for;"),
        "y = f(time);",
        UnsupportedModelError,
        "M.mo:2:62: loops of functions run over ranges of whole numbers, as 1:size(v, 1) for an array v",
    ),
    "a loop over an array in a function": Case(
        "function f input Real v[:]; output Real y = 0; algorithm for i in 1:size(v, 1) loop y := y + v[i]; "
        "end for; for x in v loop y := y + x; end for; end f; Real y;",
        "y = f({time, 1.0});",
        UnsupportedModelError,
        "M.mo:2:111: loops of functions run over ranges of whole numbers, as 1:size(v, 1) for an array v",
    ),
    "a loop with a computed bound in a function": Case(
        _function(
            "n := if x > 1 then 3 else 1; y := 0; for i in 1:n loop y := y + x; end for;",
            "protected Integer n;",
        ),
        "y = f(time);",
        UnsupportedModelError,
        "a loop of a function whose bounds depend on the arguments is not supported",
    ),
    "the largest of an enumeration": Case(
        "type E = enumeration(a, b, c); parameter E e = E.b; E f = max(e, E.c);",
        "",
        UnsupportedModelError,
        "M.mo:2:61: max() and min() of enumerations are not supported",
    ),
    "a type redeclared with attributes": Case(
        "model A replaceable type T = Real(start = 1, fixed = true); T x; equation der(x) = -x; end A; "
        "A a(redeclare type T = Real(start = 3, fixed = true));",
        "",
        UnsupportedModelError,
        "redeclaring a type with attributes in a modifier is not supported",
    ),
    "a range of numbers that are not whole": Case(
        "parameter Real k = 2; parameter Real r[:] = 0.0:0.5:k; Real s;",
        "s = sum(r);",
        UnsupportedModelError,
        "M.mo:2:40: the value of r is a range of numbers that are not whole",
    ),
    "the level of an assertion": Case(
        "parameter AssertionLevel lv = AssertionLevel.error;",
        'assert(time < 5, "late", lv);',
        UnsupportedModelError,
        "M.mo:2:13: the level of an assertion cannot be a parameter",
    ),
    "a call in a when-clause": Case(
        'function f input Real x; algorithm assert(x < 1, "large"); end f;',
        "when time > 0.5 then f(time); end when;",
        UnsupportedModelError,
        "M.mo: calling the function f alone in a when-clause is not supported",
    ),
    "a function of an array on the left": Case(
        "function f input Real u[3]; output Real y; algorithm y := u[1]; end f; "
        "Real v[3] = {1, time, 2}; Real y;",
        "2*y + f(v) = 1;",
        UnsupportedModelError,
        "it miscounts equations with such a function of an array on the left: write it on the right",
    ),
    "another value for a changed default": Case(
        "function g input Real x; input Real a = 2; output Real y; algorithm y := a*x; end g; "
        "function s = g(a = 5); Real y;",
        "y = s(time, 1);",
        UnsupportedModelError,
        "calling a function whose default value of a was changed in a short class is not supported",
    ),
    "two samples of which one reads the other": Case(
        "discrete Real x(start = 0, fixed = true); discrete Real y(start = 0, fixed = true);",
        "when sample(0, 0.3) then x = pre(x) + 1; end when; "
        "when sample(0.1, 0.2) then y = pre(y) + x; end when;",
        UnsupportedModelError,
        "a when-clause with sample() that reads what a clause with another sample() sets",
    ),
    "members of a matrix of components": Case(
        "model A Real y = time; end A; A a[2, 2]; Real s;",
        "s = sum(a.y);",
        UnsupportedModelError,
        "a.y, a member of all elements of a matrix of components, is not supported",
    ),
    "a factor that events change": Case(
        "Integer n = integer(2*time) + 1; Real x;",
        "n*x = time;",
        UnsupportedModelError,
        "an equation for an unknown that stands beside an Integer",
    ),
    "an equation of a matrix of variables": Case(
        "Real a; Real b;",
        "[a, b] = [time, 2];",
        UnsupportedModelError,
        "it miscounts equations for matrices of variables such as this one",
    ),
    "a loop in one branch": Case(
        "Real x[3]; Boolean u = time > 0.7;",
        "if u then for i in 1:3 loop x[i] = i*time; end for; else x = {1, 2, 3}; end if;",
        UnsupportedModelError,
        "a for-loop in a branch of an if-equation counts as one equation",
    ),
    "two results in a branch": Case(
        "function g input Real x; output Real a; output Real b; algorithm a := x; b := x*x; end g; "
        "Real x, y; Boolean u = time > 0.7;",
        "if u then (x, y) = g(time); else (y, x) = g(time); end if;",
        UnsupportedModelError,
        "taking several results of a function is not supported in a branch",
    ),
    "a chain of connections to elements": Case(
        _GATES + "S p; S q; A a; A b; A c;",
        "connect(a.u[1], p.y); connect(a.u[2], q.y); connect(a.y, c.u[1]); connect(q.y, c.u[2]); "
        "connect(c.y, b.u[1]); connect(q.y, b.u[2]);",
        UnsupportedModelError,
        "M.mo: the compiler does not find an order for all connections of the elements of a Boolean",
    ),
    "an impure function in a pure one": Case(
        'impure function g output Real y; external "C" y = rand(); end g; '
        "function f input Real x; output Real y; algorithm y := x*g(); end f; Real y;",
        "y = f(time);",
        ModelicaError,
        "M.mo:2:125: a function that calls the impure function g must be impure itself",
    ),
}


@pytest.mark.parametrize("case", _CASES.values(), ids=list(_CASES))
def test_message(case: Case, tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text(f"model M\n  {case.declarations}\nequation\n  {case.equations}\nend M;\n")
    with pytest.raises(BuildError) as caught:
        generate_model(BuildRequest("M", tmp_path, file))
    assert type(caught.value) is case.error
    told = str(caught.value).replace(f"{tmp_path}/", "")
    assert told.startswith(case.message) if case.message.startswith("M.mo") else case.message in told


def test_random_numbers_of_the_standard_library(tmp_path: Path) -> None:
    file = tmp_path / "Modelica.mo"
    file.write_text(
        "package Modelica package Math package Random package Utilities\n"
        '  impure function g output Real y; external "C" y = rand(); end g;\n'
        "  function f input Real x; output Real y; algorithm y := x*g(); end f;\n"
        "  model M Real y = f(time); end M;\n"
        "end Utilities; end Random; end Math; end Modelica;\n"
    )
    with pytest.raises(UnsupportedModelError, match="impure random numbers of Modelica"):
        generate_model(BuildRequest("Modelica.Math.Random.Utilities.M", tmp_path, file))


def test_a_size_that_the_compiler_cannot_compute(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text(
        "model M\n"
        "  function f input Real k; output Integer n; algorithm n := integer(ceil(k)); end f;\n"
        "  parameter Real k = 2.5; parameter Integer n = f(k);\n"
        "  Real z[n];\n"
        "equation\n  z = fill(time, n);\nend M;\n"
    )
    with pytest.raises(
        UnsupportedModelError, match=r"4:3: .*size of z, n, is not a number that the compiler can compute"
    ):
        generate_model(BuildRequest("M", tmp_path, file))


def test_a_short_class_of_a_partial_one(tmp_path: Path) -> None:
    """It is not partial itself (Modelica 3.6, section 4.6.1)."""
    file = tmp_path / "M.mo"
    file.write_text(
        "partial model P replaceable Real x = time; end P;\n"
        "model S = P(redeclare Real x = 2*time);\n"
        "model M S s; end M;\n"
    )
    with pytest.raises(UnsupportedModelError, match=r"2:1: the short class S is taken for partial"):
        generate_model(BuildRequest("M", tmp_path, file))
