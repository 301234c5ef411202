#!/usr/bin/env python3
"""scripts/api_description.py [-o FILE]: describes the public C headers as JSON, for bindings of other languages.

The headers in fxsdk/include are preprocessed (CC, otherwise cc) and parsed by pycparser. The result has

version    of the headers, such as "0.1.0"
constants  integer macros: name -> value
enums      name -> {constant -> value}; constants of enums without a name stand under "constants"
opaque     names of structs of which only pointers exist
structs    name -> {"doc", "members": [{"name", "type"}]}
callbacks  name -> {"returns", "parameters"}: typedefs of pointers to functions
functions  name -> {"doc", "returns", "parameters": [{"name", "type"}]}

A type is {"name": "float"} with the name of C, of an enum, of a struct or of a callback; {"pointer": TYPE};
{"array": TYPE, "count": 16}; or {"function": {"returns", "parameters"}}, a pointer to such a function. "const": true where
the text says so. "doc" is the comment above the declaration. Inline functions are left out; fx_defaults.h has them as
functions. Exit code 0, or 1 with the reason.
"""
import argparse
import ast
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from pycparser import c_ast, c_parser

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = ROOT / "fxsdk" / "include"
SYSTEM_HEADERS = {
    "stddef.h": "typedef unsigned long size_t;",
    "stdint.h": "".join(f"typedef {sign}{base} {name}{bits}_t;" for bits, base in
                        ((8, "char"), (16, "short"), (32, "int"), (64, "long"))
                        for sign, name in (("signed ", "int"), ("unsigned ", "uint")))
                + "\n#define INT64_C(value) value\n#define UINT64_C(value) value\n",
}


def preprocessed(text, *options):
    """What the preprocessor makes of `text`, with the public headers and without those of the system."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in SYSTEM_HEADERS.items():
            (pathlib.Path(folder) / name).write_text(content + "\n")
        run = subprocess.run([os.environ.get("CC", "cc"), "-E", "-P", "-nostdinc", "-undef", "-x", "c", *options,
                              "-D__attribute__(x)=", "-I", folder, "-I", str(INCLUDE), "-"],
                             input=text, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"scripts/api_description.py: {run.stderr.strip()}")
    return run.stdout


def integer(text):
    """The value of an integer expression of C without casts; None where `text` is something else."""
    try:
        tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError):
        return None
    allowed = (ast.Expression, ast.BinOp, ast.UnaryOp, ast.Constant, ast.operator, ast.unaryop)
    if not all(isinstance(node, allowed) for node in ast.walk(tree)):
        return None
    value = eval(compile(tree, "macro", "eval"))  # of numbers and operators alone
    return value if isinstance(value, int) else None


def macros():
    listed = preprocessed('#include "fxsdk/fxsdk.h"\n', "-dM")
    names = re.findall(r"^#define (FX_[A-Z0-9_]+) \S", listed, re.MULTILINE)
    text = '#include "fxsdk/fxsdk.h"\n' + "".join(f"@@ {name[3:]} {name}\n" for name in names)
    values = re.findall(r"^@@ (\w+) (.*)$", preprocessed(text), re.MULTILINE)
    return {"FX_" + name: integer(value) for name, value in values if integer(value) is not None}


def type_of(node):
    if isinstance(node, c_ast.TypeDecl):
        inner = node.type
        name = " ".join(inner.names) if isinstance(inner, c_ast.IdentifierType) else inner.name
        return {"name": name, **({"const": True} if "const" in node.quals else {})}
    if isinstance(node, c_ast.PtrDecl):
        if isinstance(node.type, c_ast.FuncDecl):
            return {"function": signature_of(node.type)}
        return {"pointer": type_of(node.type)}
    if isinstance(node, c_ast.ArrayDecl):
        return {"array": type_of(node.type), "count": integer(node.dim.value) if node.dim else 0}
    raise ValueError(f"a declaration that bindings cannot express: {node}")


def signature_of(function):
    parameters = [] if function.args is None else function.args.params
    return {"returns": type_of(function.type),
            "parameters": [{"name": p.name, "type": type_of(p.type)} for p in parameters
                           if not (isinstance(p.type, c_ast.TypeDecl) and type_of(p.type)["name"] == "void")]}


def enumerators(enum):
    values, following = {}, 0
    for item in enum.values.enumerators:
        if item.value is not None:
            following = value_of(item.value)
        values[item.name] = following
        following += 1
    return values


def value_of(node):
    if isinstance(node, c_ast.UnaryOp) and node.op == "-":
        return -value_of(node.expr)
    if isinstance(node, c_ast.Constant):
        return int(node.value, 0)
    raise ValueError(f"an enumerator that is not a number: {node}")


def comments():
    """The comment above each function, struct and callback of the headers."""
    above = {}
    pattern = re.compile(r"((?:^///.*\n)+)(?:FX_API[^;(]*?(fx\w+)\(|typedef struct (\w+)|typedef [^;(]*\(\*(\w+)\))", re.MULTILINE)
    for header in sorted((INCLUDE / "fxsdk").glob("*.h")):
        for comment, *names in pattern.findall(header.read_text()):
            text = "\n".join(line[3:].strip() for line in comment.strip().split("\n"))
            above[next(filter(None, names))] = text
    return above


def description():
    tree = c_parser.CParser().parse(preprocessed('#include "fxsdk/fxsdk.h"\n'))
    docs = comments()
    api = {"version": "", "constants": macros(), "enums": {}, "opaque": [], "structs": {}, "callbacks": {}, "functions": {}}
    api["version"] = ".".join(str(api["constants"][f"FX_VERSION_{part}"]) for part in ("MAJOR", "MINOR", "PATCH"))
    system = {"size_t"} | {f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)}
    for node in tree.ext:
        if isinstance(node, c_ast.Typedef):
            inner = getattr(node.type, "type", None)
            if node.name in system:
                continue
            if isinstance(inner, c_ast.Enum):
                api["enums"][node.name] = enumerators(inner)
            elif isinstance(inner, c_ast.Struct) and inner.decls is None:
                api["opaque"].append(node.name)
            elif isinstance(inner, c_ast.Struct):
                api["structs"][node.name] = {
                    "doc": docs.get(node.name, ""),
                    "members": [{"name": m.name, "type": type_of(m.type)} for m in inner.decls]}
            else:
                api["callbacks"][node.name] = {"doc": docs.get(node.name, ""), **type_of(node.type)["function"]}
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.Enum):
            api["constants"].update(enumerators(node.type))
        elif isinstance(node, c_ast.Decl) and isinstance(node.type, c_ast.FuncDecl):
            api["functions"][node.name] = {"doc": docs.get(node.name, ""), **signature_of(node.type)}
        elif not isinstance(node, c_ast.FuncDef):
            raise ValueError(f"a declaration that bindings cannot express: {node}")
    return api


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", help="FILE; otherwise standard output")
    options = parser.parse_args()
    text = json.dumps(description(), indent=1) + "\n"
    if not options.output:
        sys.stdout.write(text)
        return
    output = pathlib.Path(options.output)
    output.parent.mkdir(parents=True, exist_ok=True)
    part = output.with_name(output.name + ".part")
    part.write_text(text)
    part.replace(output)


if __name__ == "__main__":
    main()
