"""Compares the list of comparisons that rest on a bound with the detector's sources."""
import re
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent

# A line of code that calls a function which compares with a bound, that compares with a name of a
# bound or of an end of a range, or that makes a bound.
FOUND = [re.compile(p) for p in (
    r"\b(sign_beyond|sure_sign|same_side|sure_side|sure_sign_of_minor|sure|sure_value_sign|apart|apart_at_start"
    r"|is_surely_near|boxes_are_apart|misses|separated_along_an_axis)(<[^()]*>)?\(",
    r" [<>]=? .*\b\w*(bound|error|slack|margin|minus|radius|unit)_?\b",
    r"\b\w*(bound|error|slack|margin|radius)_? [<>]=? ",
    r"\b(now|from|to)\.level\b",
    r"(\.|\b)(lo|hi)(_t[01]|\[k[^\]]*\])? [<>] (0\b|\w+\.(lo|hi)(_t[01]|\[))",
    r"\bb - a > by\b|return a < b;|> r\b",
    r" [<>] (least|greatest)_(magnitude|size)\b|\b(least|greatest)_(magnitude|size) = 0x",
    r"\b(unit_roundoff|Bounds::unit)\b|0x1p-(2[0-4]|4[0-9]|5[0-4])f?\b",
    r"\bepsilon\(|\b\d(\.\d+)?e-\d+",
)]


def found_in(sources):
    """Yields (file, line) for each line that looks like a comparison with a bound."""
    for file, text in sources:
        for line in text.split("\n"):
            code = line.split("//")[0].strip()
            if any(pattern.search(code) for pattern in FOUND):
                yield file, code


def sources_of(root):
    for path in sorted((root / "detector").rglob("*")):
        if path.suffix in (".h", ".cpp") and path.parent.name != "plugin":
            yield str(path.relative_to(root / "detector")), path.read_text()


def listed():
    """Returns comparisons.txt as {(file, line): what the comparison rests on}."""
    lines, file = {}, None
    for line in (HERE / "comparisons.txt").read_text().split("\n"):
        if line.startswith("  "):
            rests_on, code = line.split(" | ", 1)
            lines[file, code.strip()] = [part.strip() for part in rests_on.split(",")]
        elif line and not line.startswith("#"):
            file = line
    return lines


def faults(sources, claims):
    """Returns the errors of the list. `claims` are the names of the proved claims."""
    of_list, found = listed(), set(found_in(sources))
    lemmas = set(re.findall(r"^\*\*(\d+)\.", (HERE.parent / "README.md").read_text(), re.M))
    wrong = [f"not in comparisons.txt: {file}: {code}" for file, code in sorted(found - set(of_list))]
    wrong += [f"no such line: {file}: {code}" for file, code in sorted(set(of_list) - found)]
    used = set()
    for (file, code), rests_on in of_list.items():
        for name in rests_on:
            used.add(name)
            known = (name == "nothing" or name in claims or
                     (name.startswith("lemma ") and name.split()[1] in lemmas))
            if not known:
                wrong.append(f"{file}: rests on {name}, which is neither proved nor a lemma: {code}")
    wrong += [f"nothing rests on {name}" for name in sorted(claims - used)]
    return wrong
