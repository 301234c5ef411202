#!/usr/bin/env python3
"""scripts/document_code.py PAGE.md OUTPUT.c: writes the C code of a page, all blocks ```c in their order, as one file.

Lines keep their numbers and the name of the page, so that messages of a compiler point into the page. Exit code 0, or 1
when the page has no such block.
"""
import pathlib
import sys


def code_of(page):
    out, inside = [], False
    for number, line in enumerate(page.read_text().split("\n"), 1):
        if inside and line == "```":
            inside = False
        elif inside:
            out.append(line)
        elif line == "```c":
            inside = True
            out.append(f'#line {number + 1} "{page}"')
    return out


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    code = code_of(pathlib.Path(sys.argv[1]))
    if not code:
        sys.exit(f"{sys.argv[1]} has no block of C")
    pathlib.Path(sys.argv[2]).write_text("\n".join(code) + "\n")


if __name__ == "__main__":
    main()
