"""The C API by ctypes: every struct, enum, constant and function that api.json describes.

api.json lies beside this file and is made from the headers by scripts/api_description.py. A function that returns
FxResult raises Error unless the result is FX_OK. Structs with a member structSize get it when they are created.
"""
import ctypes
import difflib
import json
import os
import pathlib
import sysconfig

_HERE = pathlib.Path(__file__).resolve().parent
API = json.loads((_HERE / "api.json").read_text())

_SCALARS = {
    "char": ctypes.c_char, "int": ctypes.c_int, "float": ctypes.c_float, "double": ctypes.c_double, "size_t": ctypes.c_size_t,
    **{f"{'' if sign == 'int' else 'u'}int{bits}_t": getattr(ctypes, f"c_{sign}{bits}")
       for sign in ("int", "uint") for bits in (8, 16, 32, 64)},
}


class Error(RuntimeError):
    """A call of the library that failed; `name` is that of its result, such as "not-found"."""

    def __init__(self, code, name, message):
        super().__init__(message)
        self.code, self.name = code, name


class _Struct(ctypes.Structure):
    def __init__(self, **members):
        super().__init__(**members)
        if hasattr(type(self), "structSize"):
            self.structSize = ctypes.sizeof(self)

    def __repr__(self):
        return f"{type(self).__name__}({', '.join(f'{name}={getattr(self, name)!r}' for name, _ in self._fields_)})"


class _Types:
    """The types of ctypes for the types of api.json."""

    def __init__(self):
        self.by_name = dict(_SCALARS)
        self.by_name.update({name: ctypes.c_int32 for name in API["enums"]})
        self.by_name.update({name: type(name, (_Struct,), {}) for name in API["opaque"]})
        self.by_name.update({name: type(name, (_Struct,), {"__doc__": struct["doc"]})
                             for name, struct in API["structs"].items()})
        self.by_name.update({name: self.function(signature) for name, signature in API["callbacks"].items()})
        for name, struct in API["structs"].items():  # those that are members of others come first in the headers
            self.by_name[name]._fields_ = [(m["name"], self.member(m["type"])) for m in struct["members"]]

    def named(self, name):
        return None if name == "void" else self.by_name[name]

    def member(self, described):
        if "array" in described:
            return self.member(described["array"]) * described["count"]
        return self.parameter(described)

    def parameter(self, described):
        if "name" in described:
            return self.named(described["name"])
        if "function" in described:
            return self.function(described["function"])
        pointee = described.get("pointer") or described["array"]  # an array of a parameter is a pointer
        if "name" not in pointee:
            return ctypes.POINTER(self.parameter(pointee))
        if pointee["name"] == "void":
            return ctypes.c_void_p
        if pointee["name"] == "char" and pointee.get("const"):
            return ctypes.c_char_p
        return ctypes.POINTER(self.named(pointee["name"]))

    def function(self, signature):
        return ctypes.CFUNCTYPE(self.parameter(signature["returns"]),
                                *(self.parameter(p["type"]) for p in signature["parameters"]))


def _places():
    """Where the library may be: FXSDK_LIBRARY, beside the installed package, or where the system looks."""
    name = "libfxsdk.so." + API["version"].split(".")[0]
    if "FXSDK_LIBRARY" in os.environ:
        return [os.environ["FXSDK_LIBRARY"]]
    multiarch = sysconfig.get_config_var("MULTIARCH") or ""
    folders = [parent / lib for parent in _HERE.parents for lib in ("lib", f"lib/{multiarch}", "lib64")]
    return [str(folder / name) for folder in folders if (folder / name).is_file()] + [name]


def _load():
    places = _places()
    for place in places:
        try:
            return ctypes.CDLL(place)
        except OSError as error:
            reason = error
    raise ImportError(f"libfxsdk cannot be loaded ({reason}); set FXSDK_LIBRARY to the path of libfxsdk.so")


class _Functions:
    """The functions of the library, by their names in C."""

    def __init__(self, library):
        for name, described in API["functions"].items():
            function = getattr(library, name)
            function.argtypes = [_types.parameter(p["type"]) for p in described["parameters"]]
            function.restype = _types.parameter(described["returns"])
            function.__doc__ = described["doc"]
            if described["returns"] == {"name": "FxResult"}:
                function.errcheck = self._check
            setattr(self, name, function)

    def _check(self, result, function, arguments):
        if result != 0:
            raise Error(result, self.fxResultName(result).decode(), self.fxGetLastErrorMessage().decode())
        return result


_types = _Types()
fx = _Functions(_load())

#: Structs by their names in C, such as structs.FxViewSettings().
structs = type("structs", (), {name: _types.by_name[name] for name in API["structs"]})
#: Constants and enumerators by their names in C.
constants = type("constants", (), {**API["constants"], **{name: value for enum in API["enums"].values()
                                                          for name, value in enum.items()}})


def opaque(name):
    """A null pointer to an object such as FxScene, to be filled by a function that creates one."""
    return ctypes.POINTER(_types.by_name[name])()


def default(name):
    """A struct with its defaults. @param name such as "FxSceneDef" """
    struct = _types.by_name[name]()
    getattr(fx, "fxGetDefault" + name[2:])(ctypes.byref(struct))
    return struct


def filled(name, read, *arguments):
    """A struct that `read`, a function of the C API, fills. The pointer to it is the last argument."""
    struct = _types.by_name[name]()
    read(*arguments, ctypes.byref(struct))
    return struct


def assign(struct, members):
    """Sets members of a struct from a mapping; sequences are copied into arrays, true and false are 1 and 0."""
    known = {name for name, _ in struct._fields_}
    for name, value in members.items():
        if name not in known:
            near = difflib.get_close_matches(name, known, 1, 0.5)
            meant = f"did you mean {near[0]}?" if near else f"it has {', '.join(sorted(known - {'structSize', 'reserved'}))}"
            raise TypeError(f"{type(struct).__name__} has no member {name}; {meant}")
        member = getattr(struct, name)
        if isinstance(member, ctypes.Array) and not isinstance(value, bytes):
            if len(value) != len(member):
                raise ValueError(f"{name} has {len(member)} components, {len(value)} were given")
            member[:] = [float(component) for component in value]
        else:
            setattr(struct, name, value)
    return struct
