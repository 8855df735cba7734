"""Recorded output of OpenModelica 1.14.2; only folders are renamed."""

from __future__ import annotations

ROOT_REFUSAL = """\
Error: You are trying to run OpenModelica as a server using the root user.
This is a very bad idea:
* The socket interface does not authenticate the user.
* OpenModelica allows execution of arbitrary commands.
"""

SYNTAX_ERROR = "[/home/user/lib/bad.mo:4:1-4:1:writable] Error: Missing token: SEMICOLON\n"

# Quotation marks inside stay as they are in this version.
TYPE_ERROR = """\
[/home/user/lib/M5.mo:1:10-1:21:writable] Error: Type mismatch in binding x = "a", expected subtype of Real, \
got type String.
Error: Error occurred while flattening model M5
"""

UNKNOWN_VARIABLE = """\
[/home/user/lib/M2.mo:1:27-1:31:writable] Error: Variable y not found in scope M2.
Error: Error occurred while flattening model M2
"""

TOO_FEW_EQUATIONS = """\
Error: Too few equations, under-determined system. The model has 1 equation(s) and 2 variable(s).
[/home/user/lib/M4.mo:1:18-1:23:writable] Warning: Variable y does not have any remaining equation to be \
solved in.
  The original equations were:
"""

UNKNOWN_CLASS = """\
Error: Failed to load package NoSuch (default) using MODELICAPATH /opt/om/lib/omlibrary:/home/user/libraries/.
Error: Class NoSuch.Model not found in scope <TOP>.
"""

WARNINGS = """\
[/home/user/lib/M6.mo:1:28-1:43:writable] Warning: Parameter p has no value, and is fixed during \
initialization (fixed=true), using available start value (start=0.0) as default value.
Warning: The initial conditions are not fully specified. For more information set -d=initialization. \
In OMEdit Tools->Options->Simulation->OMCFlags, in OMNotebook call setCommandLineOptions("-d=initialization").
"""

UNKNOWN_FMI_VERSION = "Error: Unknown FMU version 3.0. Only version 1.0 & 2.0 are supported.\n"

UNKNOWN_OPTION = "Error: Unknown option --fmiFlags.\n"

MISSING_C_COMPILER = """\
Error: Error building simulator. Build log: no-such-cc -Os -fPIC -falign-functions -mfpmath=sse \
-fno-dollars-in-identifiers  -DOMC_MINIMAL_RUNTIME=1 -DCMINPACK_NO_DLL=1 -I'/opt/om/include/omc/c/fmi'  \
-c -o B3.o B3.c
make: no-such-cc: Permission denied
make: *** [<builtin>: B3.o] Error 127
"""

# A script of four watched statements, with MARK for the marker.
SCRIPT_OUTPUT = """\
"OMCompiler v1.14.2"
"MARK"
""
"MARK"
false
"MARK"
"Error: Unknown option --fmiFlags.
"
"MARK"
true
"MARK"
""
"MARK"
""
"MARK"
"[/home/user/lib/M5.mo:1:10-1:21:writable] Error: Type mismatch in binding x = "a", expected subtype of \
Real, got type String.
Error: Error occurred while flattening model M5
"
"MARK"
"""

# What a server answers to what it cannot parse.
NOT_PARSED = """\
Error occurred building AST
Syntax Error
[<interactive>:1:0-1:0:writable] Error: Parser error: Unexpected token near: 1 (UNSIGNED_INTEGER)
"""
