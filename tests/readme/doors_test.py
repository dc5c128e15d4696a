"""Tests that doors.py finds the errors of a page, on a small page."""
import contextlib
import io
import sys
import unittest

sys.dont_write_bytecode = True  # the sources' folder stays as it is
from doors import Door, Page, Shell

PAGE = """# A page

## Before you begin

    read -r answer && [ "$answer" = y ]

## 1. A fault

    export FAULT=here
    test -z "$FAULT" || (echo DEFECT 7 in 3 s; exit 1)

    DEFECT 7 in 99 s

```cpp
int no_command;
```

## 2. It is mended

    unset FAULT
    test -z "$FAULT"
"""
BUILT = ['read -r answer && [ "$answer" = y ]']
FAILS, PASSES = 'test -z "$FAULT" || (echo DEFECT 7 in 3 s; exit 1)', 'test -z "$FAULT"'


class Doors(unittest.TestCase):
    def wrongs(self, text, is_built=False, sections=("1.", "2."), ends=(1,), built=BUILT):
        page = Page(text, {FAILS: ends}, {FAILS: "DEFECT 7"}, {"DEFECT 7": "", "int no": ""})
        shell = Shell([])
        with contextlib.redirect_stdout(io.StringIO()):
            page.go_through(shell, {"it": Door(sections, FAILS, PASSES)}, built, is_built)
        shell.close()
        return [wrong.splitlines()[0] for wrong in page.wrongs]

    def test_a_right_page(self):
        self.assertEqual(self.wrongs(PAGE), [])
        self.assertEqual(self.wrongs(PAGE, is_built=True), [])

    def test_a_line_that_is_wrong_ends_its_door(self):
        self.assertEqual(self.wrongs(PAGE.replace("export", "exprot")),
                         ["9: ends with 127, not 0: exprot FAULT=here"])
        self.assertEqual(self.wrongs(PAGE.replace("    unset FAULT\n", "")),
                         [f"20: ends with 1, not 0: {PASSES}"])
        self.assertEqual(self.wrongs(PAGE.replace("    export", "    if export")),
                         ["9: ends with 2, not 0: if export FAULT=here"])
        self.assertEqual(self.wrongs(PAGE.replace("unset FAULT", "exit 0")),
                         ["20: ends with None, not 0: exit 0"])

    def test_a_build_that_is_wrong_opens_no_door(self):
        fails = "false " + BUILT[0]
        self.assertEqual(self.wrongs(PAGE.replace(BUILT[0], fails), built=[fails]),
                         [f"5: ends with 1, not 0: {fails}"])
        self.assertEqual(self.wrongs(PAGE.replace(BUILT[0], fails))[0],
                         f"0: the page has no such line: {BUILT[0]}")

    def test_output_that_is_not_printed(self):
        self.assertEqual(self.wrongs(PAGE.replace("DEFECT 7 in 99 s", "DEFECT 7 in 99 s\n    of 8")),
                         ["13: is shown, and not printed: of 8"])

    def test_a_gate_that_does_not_end_so(self):
        self.assertEqual(self.wrongs(PAGE.replace("    export FAULT=here\n", "")),
                         [f"9: ends with 0, not 1: {FAILS}"])
        self.assertEqual(self.wrongs(PAGE.replace("|| (", "|| ! ("), ends=(0,))[0],
                         f"0: no gate that ends with 1: {FAILS}")

    def test_a_line_behind_no_door(self):
        self.assertEqual(self.wrongs(PAGE + "\n## 3. More\n\n    false\n"), ["25: behind no door: false"])


if __name__ == "__main__":
    unittest.main()
