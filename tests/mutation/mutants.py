"""Makes mutants of C++ sources, each of which has one small change in one line.

The sources are clang-formatted, so binary operators have spaces around them and brackets of
templates have none. If a change does not compile, the compiler finds it out.
"""
import hashlib
import re
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Mutant:
    file: str  # relative to the root
    number: int  # of the line, from 1
    line: str  # the unchanged line, without the indent
    mutated: str
    kind: str

    def key(self):
        return (self.file, self.line, self.mutated)


OPERATORS = {"+": "-", "-": "+", "*": "+", "/": "*", "<": "<=", "<=": "<", ">": ">=", ">=": ">",
             "==": "!=", "!=": "==", "&&": "||", "||": "&&", "+=": "-=", "-=": "+=", "|=": "=",
             "&": "|", "|": "&", "<<": ">>", ">>": "<<"}
OPERATOR = re.compile(r"(?<= )(\+=|-=|\|=|<=|>=|==|!=|&&|\|\||<<|>>|[-+*/<>&|])(?= )")
NUMBER = re.compile(r"(?<![\w.\"'])(\d+)(?![\w.'])")
FRACTION = re.compile(r"(?<![\w.])(\d+\.\d*)(?![\w.])")
CALL = re.compile(r"(?:[\w:\[\]]+(?:\.|->|::))*\w+\(.*\);$")
NOT_A_CALL = re.compile(r"(return|if|for|while|switch|assert|static_assert|delete|throw|using)\b")
SKIPPED = re.compile(r"\b(static_assert|assert|template|using|namespace|typename|operator|Stopwatch|"
                     r"override;|= default|= delete|__attribute__|_mm\d*_set)\b|^#|^case |^friend ")
FUNCTION = re.compile(r"^(?:static |inline |constexpr )*(void|bool) [\w:]+\(.*\{$")


def without_comments(text):
    """Returns the text with comments and strings replaced by blanks, line by line."""
    def blank(match):
        return re.sub(r"[^\n]", " ", match.group())
    return re.sub(r"//[^\n]*|/\*.*?\*/|\"(?:\\.|[^\"\\\n])*\"|'(?:\\.|[^'\\\n])'", blank, text,
                  flags=re.S)


def closing(text, start):
    """Returns the index of the bracket that closes the bracket at `start`, or -1."""
    depth = 0
    for i in range(start, len(text)):
        depth += (text[i] == "(") - (text[i] == ")")
        if depth == 0:
            return i
    return -1


def changes(code):
    """Yields each change of one line of code, as (kind, from, to, replacement)."""
    for m in OPERATOR.finditer(code):
        yield "operator", m.start(), m.end(), OPERATORS[m.group()]
    for m in NUMBER.finditer(code):
        if code[m.end():m.end() + 1] == ">" or code[:m.start()].endswith("<"):
            continue  # an argument of a template
        value = int(m.group())
        yield "constant", m.start(), m.end(), str({0: 1, 1: 0}.get(value, value + 1))
    for m in FRACTION.finditer(code):
        yield "constant", m.start(), m.end(), f"(2 * {m.group()})"
    for m in re.finditer(r"\bif (constexpr )?\(", code):
        end = closing(code, m.end() - 1)
        if end > 0:
            yield "condition", m.end(), end, f"!({code[m.end():end]})"
    for m in re.finditer(r"\bstd::(min|max)\(", code):
        yield "min-max", m.start(1), m.end(1), {"min": "max", "max": "min"}[m.group(1)]
    for m in re.finditer(r"\b(true|false)\b", code):
        yield "truth", m.start(), m.end(), {"true": "false", "false": "true"}[m.group()]
    for m in re.finditer(r"(?<=return )[^;]* [<>=!|&]+ [^;]*(?=;$)", code):
        yield "return", m.start(), m.end(), "true"
        yield "return", m.start(), m.end(), "false"
    if re.fullmatch(r"\s*(if .*\) )?(continue|break);", code):
        m = re.search(r"continue|break", code)
        other = {"continue": "break", "break": "continue"}[m.group()]
        yield "loop", m.start(), m.end(), other
    stripped = code.strip()
    if CALL.fullmatch(stripped) and not NOT_A_CALL.match(stripped):
        start = code.index(stripped)
        yield "call", start, len(code.rstrip()), ";"
    m = FUNCTION.match(stripped)
    if m:
        yield "return", len(code), len(code), {"void": " return;", "bool": " return false;"}[m[1]]


def mutants_of(root, file):
    text = (Path(root) / file).read_text()
    lines, codes = text.split("\n"), without_comments(text).split("\n")
    for i, (line, code) in enumerate(zip(lines, codes)):
        if SKIPPED.search(code.strip()):
            continue
        statement_before = i == 0 or codes[i - 1].rstrip().endswith((";", "{", "}", ":")) \
            or not codes[i - 1].strip()
        for kind, start, end, replacement in changes(code):
            if kind == "call" and not statement_before:
                continue
            mutated = line[:start] + replacement + line[end:]
            yield Mutant(file, i + 1, line.strip(), mutated.strip(), kind)


def area_weight(file):
    """Returns how often lines of a file are drawn: most often those of the core of the detector."""
    core = ("view/", "contact/", "boundary/", "search/", "state/", "step/", "geometry/")
    weight = 2.0 if file.removeprefix("detector/").startswith(core) else 1.0
    return weight * (0.25 if file.endswith(".h") else 1.0)


def drawn(seed, mutant, nth):
    """Returns a number that depends only on the mutant's text, so that other edits keep the drawn mutants."""
    text = "\0".join([str(seed), *mutant.key(), str(nth)])
    return hashlib.sha256(text.encode()).hexdigest()


def in_random_order(seed, mutants):
    """Returns the mutants in random order, mixed by kind, so that rare kinds come early, too."""
    seen, by_kind = {}, {}
    for mutant in mutants:
        nth = seen[mutant.key()] = seen.get(mutant.key(), 0) + 1
        by_kind.setdefault(mutant.kind, []).append((drawn(seed, mutant, nth), mutant))
    ranked = []
    for of_kind in by_kind.values():
        of_kind.sort(key=lambda entry: entry[0])
        # The n-th of k mutants of a kind is put at about n / (1 + sqrt(k)).
        ranked += [((n + int(d[:8], 16) / 2**32) / (1 + len(of_kind)**0.5), d, mutant)
                   for n, (d, mutant) in enumerate(of_kind)]
    return [mutant for _, _, mutant in sorted(ranked, key=lambda entry: entry[:2])]


def quotas(weights, total):
    """Returns the number of mutants of each file: at least one of a source, the others in proportion (by the
    largest remainders). A mutated header costs more, and has fewer statements."""
    least = {f: int(f.endswith(".cpp")) for f in weights}
    rest = max(0, total - sum(least.values()))
    whole = sum(weights.values())
    shares = {f: rest * w / whole for f, w in weights.items()}
    out = {f: least[f] + int(s) for f, s in shares.items()}
    by_remainder = sorted(shares, key=lambda f: (int(shares[f]) - shares[f], f))
    for f in by_remainder[:max(0, total - sum(out.values()))]:
        out[f] += 1
    return out
