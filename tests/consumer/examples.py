"""examples.py FOLDER OUTPUT: makes a test of the examples in the headers below FOLDER.

An example is a paragraph of a comment that is indented by three blanks and follows a sentence with a colon at its end.
Each header has one or more examples and gives one test. examples.cpp has the code around the examples. An example that
defines a type is put outside of functions.
"""
import re
import sys
from itertools import takewhile
from pathlib import Path

COMMENT = re.compile(r"\s*(?://| ?/?\*(?!/))(.*)")
DEFINITION = re.compile(r"(class|enum|struct|template)\b")
CALL = re.compile(r"\b(use|respond)\(")


def examples_of(header):
    """Returns the number of the first line of each example, counted from 1, and its lines."""
    lines = [match[1] if (match := COMMENT.fullmatch(line)) else None
             for line in header.read_text().splitlines()]
    for i, line in enumerate(lines):
        if line and line.startswith("   ") and lines[i - 1] == "":
            if not (lines[i - 2] or "").endswith(":"):
                sys.exit(f"{header}:{i + 1}: no sentence that ends with a colon leads to this")
            yield i + 1, list(takewhile(lambda text: text and text.startswith("   "), lines[i:]))


def test_of(header, name):
    fixture = "InArrays" if "/plugin/" in name else "InMatrices"
    outside, inside = "", ""
    for line, code in examples_of(header):
        block = "\n".join([f'#line {line} "{name}"', *code, ""])
        if DEFINITION.match(code[0].strip()):
            outside += block
        else:
            inside += "{\n" + block + "}\n" + "EXPECT_TRUE(is_used());\n" * bool(CALL.search(block))
    if not outside + inside:
        sys.exit(f"{header}: a public header shows by an example how it is used")
    test = f"TEST_F({fixture}, {re.sub('[^a-z]', '_', name)}) {{\n{inside}}}\n"
    return outside + test * bool(inside)


folder, output = Path(sys.argv[1]), Path(sys.argv[2])
headers = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*.h*"))}
includes = "".join(f'#include "{name}"\n' for name in headers)
tests = "".join(test_of(path, name) for name, path in headers.items())
output.write_text(f"{includes}namespace examples {{\n{tests}}}\n")
