#!/usr/bin/env python3
"""particle_page.py [--write]: the tables of docs/howto/particles.md from the schemas of emitters and effects.

Between `<!-- members: NAME -->` and `<!-- end -->` stands the table of the members of one object of the schema: NAME is
its path in the element of "emitters", such as forces.vortices, `emitter` for the element itself, or `effect` for the
preset around it. Without --write the
tables are compared. Exit code 0, or 1 with one line per fault: a table that differs, an object that has none.
"""
import json
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
SCHEMA = ROOT / "fxsdk/presets/emitters/emitters.schema.json"
EFFECT = ROOT / "fxsdk/presets/schema/effect.schema.json"
PAGE = ROOT / "docs/howto/particles.md"
TABLE = re.compile(r"<!-- members: (\S+) -->\n(.*?)<!-- end -->", re.S)


def with_parts(schema):
    """Objects that several techniques share stand in files of their own."""
    if "x-part" in schema:
        return json.loads((EFFECT.parent / schema["x-part"]).read_text())
    return {name: with_parts(value) if isinstance(value, dict) else value for name, value in schema.items()}


def members_of(schema):
    return schema.get("items", schema).get("properties")


def objects(schema, path=""):
    """Every object of the schema that has members: its path and those."""
    members = members_of(schema)
    if members is None:
        return
    yield path or "emitter", members
    for name, member in members.items():
        yield from objects(member, f"{path}.{name}" if path else name)


def number(value):
    return f"{value:g}" if isinstance(value, float) else str(value)


def allowed(member):
    if "enum" in member:
        return ", ".join(f"`{name}`" for name in member["enum"])
    kind = {"vector": "x, y, z; ", "extent": "number or x, y, z; ", "range": "number or min, max; ",
            "curve": "number or curve; ", "colorCurve": "color or curve; "}.get(member.get("x-kind"), "")
    if "minimum" in member and "maximum" in member:
        return f"{kind}{number(member['minimum'])} to {number(member['maximum'])}"
    return {"boolean": "`true`, `false`", "string": "text", "object": "see below", "array": "list, see below"}.get(
        member.get("type"), kind.rstrip("; "))


def table(members):
    rows = ["| member | allowed | unit | default | meaning |", "|---|---|---|---|---|"]
    for name, member in members.items():
        default = member.get("default")
        shown = "" if default is None or default == "" else f"`{json.dumps(default)}`"
        unit = member.get("x-unit", "")
        cost = f" Costs {member['x-cost']}." if "x-cost" in member else ""
        meaning = member["description"] + cost
        rows.append(f"| `{name}` | {allowed(member)} | {unit} | {shown} | {meaning} |")
    return "\n".join(rows) + "\n"


def main(arguments):
    tables = {path: table(members) for path, members in objects(with_parts(json.loads(SCHEMA.read_text())))}
    tables["effect"] = table(json.loads(EFFECT.read_text())["properties"])
    page = PAGE.read_text()
    faults = [f"{PAGE.name}: no table of {path}" for path in tables if f"<!-- members: {path} -->" not in page]

    def renewed(match):
        path, found = match.groups()
        if path not in tables:
            faults.append(f"{PAGE.name}: the schema has no object {path}")
            return match.group(0)
        if found != tables[path] and "--write" not in arguments:
            faults.append(f"{PAGE.name}: the table of {path} is not what the schema says; run scripts/particle_page.py --write")
        return f"<!-- members: {path} -->\n{tables[path]}<!-- end -->"

    text = TABLE.sub(renewed, page)
    if "--write" in arguments:
        PAGE.write_text(text)
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
