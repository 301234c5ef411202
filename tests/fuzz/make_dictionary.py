#!/usr/bin/env python3
"""make_dictionary.py OUTPUT SCHEMA...

Writes a dictionary for libFuzzer: every member name and every choice of the JSON schemas, and numbers at limits.
"""
import json
import pathlib
import sys

SYNTAX = ["{", "}", "[", "]", ":", ",", "true", "false", "null", "[0, 1]", "{}", "[]", '""', "\\u0000", "library:"]
NUMBERS = ["0", "-1", "1e-30", "1e30", "1e308", "-0.0", "0.001", "16777216", "2147483648", "4294967295", "9007199254740993"]


def words_of(schema):
    """Member names and choices anywhere in a schema."""
    if isinstance(schema, list):
        return set().union(*map(words_of, schema)) if schema else set()
    if not isinstance(schema, dict):
        return set()
    words = set(schema.get("properties", {}))
    words |= {choice for choice in schema.get("enum", []) if isinstance(choice, str)}
    for value in schema.values():
        words |= words_of(value)
    return words


def main(output, schemas):
    words = set().union(*(words_of(json.loads(pathlib.Path(path).read_text())) for path in schemas))
    entries = [json.dumps(word) for word in sorted(words)] + SYNTAX + NUMBERS
    pathlib.Path(output).write_text("".join(json.dumps(entry) + "\n" for entry in entries)) # escapes as libFuzzer reads


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
