#!/usr/bin/python3
"""Confirms the numbers printed in FINDINGS.md, and the cases of meshes/, by arithmetic that nothing
else here uses: fractions, polynomials through values at five times, and Sturm's theorem.

It prints a line for each finding. Its exit code is 1 if a finding or a case is refuted.
"""
import json
import math
import re
import sys
from fractions import Fraction
from itertools import combinations, zip_longest
from pathlib import Path

HERE = Path(__file__).resolve().parent
MESHES, VECTORS = HERE / "meshes", HERE.parent / "vectors"
MOST_WORDS = 150  # of a finding, so that it fits into an issue
# Beyond the step, and no short fractions, so that no midpoint of a bisection is a root or an end.
LO, HI = Fraction(-1, 10007), 1 + Fraction(1, 10009)


def value(p, t):
    return sum(c * t**i for i, c in enumerate(p))


def trimmed(p):
    return trimmed(p[:-1]) if p and p[-1] == 0 else p


def remainder(p, q):
    while len(p) >= len(q):
        shifted = [0] * (len(p) - len(q)) + q
        p = trimmed([a - p[-1] / q[-1] * b for a, b in zip(p, shifted)][:-1])
    return p


def polynomial(values):
    """Returns the polynomial that has these values at 0, 1, 2, ..."""
    total, basis = [], [Fraction(1)]
    for k, v in enumerate(values):
        factor = (v - value(total, k)) / value(basis, k)
        total = [a + factor * b for a, b in zip_longest(total, basis, fillvalue=0)]
        basis = [a - k * b for a, b in zip([0, *basis], [*basis, 0])]
    return trimmed(total)


def count(p, lo, hi):
    """Returns the number of different roots of p between lo and hi."""
    chain = [p, trimmed([i * c for i, c in enumerate(p)][1:])]
    while chain[-1]:
        chain.append([-c for c in remainder(chain[-2], chain[-1])])
    signs = [[value(q, t) > 0 for q in chain[:-1]] for t in (lo, hi)]
    changes = [sum(a != b for a, b in zip(s, s[1:])) for s in signs]
    return changes[0] - changes[1]


class Root:
    """The only root of p between lo and hi."""

    def __init__(self, p, lo, hi):
        self.p, self.lo, self.hi = p, lo, hi

    def sign(self, q):
        """Returns the sign of the polynomial q at this root."""
        p, shared = q, self.p
        while p:
            p, shared = remainder(shared, p), p
        if not q or count(shared, self.lo, self.hi):
            return 0
        while count(q, self.lo, self.hi):
            middle = (self.lo + self.hi) / 2
            is_left = count(self.p, self.lo, middle)
            self.lo, self.hi = (self.lo, middle) if is_left else (middle, self.hi)
        return 1 if value(q, self.lo) > 0 else -1

    def compared(self, t):
        return self.sign([-t, Fraction(1)])


def roots(p, lo=LO, hi=HI):
    """Returns the roots of p in the step."""
    found, middle = count(p, lo, hi), (lo + hi) / 2
    if found > 1:
        return roots(p, lo, middle) + roots(p, middle, hi)
    one = [Root(p, lo, hi)] if found else []
    return [t for t in one if t.compared(0) >= 0 and t.compared(1) <= 0]


def minus(u, v):
    return [a - b for a, b in zip(u, v)]


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def cross(u, v):
    return [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]


def points_at(t, x0, x1):
    return [[Fraction(a) * (1 - t) + Fraction(b) * t for a, b in zip(*p)] for p in zip(x0, x1)]


def facts(is_face, a, b, c, d):
    """Returns for four points: volume, normal (3), values that are >= 0 where the features overlap;
    for each end point and segment: three values, 0 on its line, and a value >= 0 between ends."""
    if is_face:
        normal = cross(minus(c, b), minus(d, b))
        inside = [dot(cross(minus(q, p), minus(a, p)), normal) for p, q in ((b, c), (c, d), (d, b))]
        ends = (a, b, c), (a, c, d), (a, d, b)
    else:
        normal = cross(minus(b, a), minus(d, c))
        inside = [dot(cross(minus(c, a), way), normal) for way in (minus(d, c), minus(b, a))]
        inside += [dot(normal, normal) - share for share in inside]
        ends = (a, c, d), (b, c, d), (c, a, b), (d, a, b)
    on = [[*cross(minus(v, p), minus(q, p)), dot(minus(v, p), minus(q, v))] for v, p, q in ends]
    return [dot(minus(b, a), cross(minus(c, a), minus(d, a))), *normal, *inside, *sum(on, [])]


def contacts(is_face, x0, x1):
    """Returns times of the step at which the features meet; the first such time is among them."""
    values = [facts(is_face, *points_at(t, x0, x1)) for t in range(5)]
    volume, *others = map(polynomial, zip(*values))
    borders = 3 if is_face else 4
    normal, inside, rest = others[:3], others[3:3 + borders], others[3 + borders:]

    def meets(sign):
        if any(map(sign, normal)):
            return all(sign(p) >= 0 for p in inside)
        return any(not any(map(sign, rest[i:i + 3])) and sign(rest[i + 3]) >= 0
                   for i in range(0, len(rest), 4))

    events = [volume] if volume else [[Fraction(0), Fraction(1)], *filter(None, others)]
    return [t for p in events for t in roots(p) if meets(t.sign)]


def pierces(triangle, other, x):
    """Returns whether an edge of `triangle` passes strictly through `other`. An edge that only
    touches is a contact of two features."""
    def side(*four):
        a, *rest = ([Fraction(c) for c in x[i]] for i in four)
        volume = dot(minus(rest[0], a), cross(minus(rest[1], a), minus(rest[2], a)))
        return (volume > 0) - (volume < 0)

    for p, q in combinations(triangle, 2):
        around = {side(p, q, other[i - 1], other[i]) for i in range(3)}
        if side(p, *other) * side(q, *other) < 0 and around in ({1}, {-1}):
            return True
    return False


def mesh_contacts(triangles, x0, x1):
    if any(pierces(a, b, x0) for pair in combinations(triangles, 2) for a, b in (pair, pair[::-1])):
        return roots([Fraction(0), Fraction(1)])
    asked = []
    for a, b in combinations(triangles, 2):
        asked += [(True, [v, *b]) for v in a] + [(True, [v, *a]) for v in b]
        asked += [(False, [*e, *f]) for e in combinations(a, 2) for f in combinations(b, 2)]
    return [t for is_face, four in asked if len(set(four)) == 4
            for t in contacts(is_face, [x0[i] for i in four], [x1[i] for i in four])]


def begin(times, lo, hi):
    """Returns whether the first time is in [lo, hi]; if lo is None, whether `times` is empty."""
    if lo is None:
        return not times
    return all(t.compared(lo) >= 0 for t in times) and any(t.compared(hi) <= 0 for t in times)


def square(a, b, c, d):
    """Returns the squared distance of a vertex from a face."""
    sizes = []
    for p, q in ((b, c), (c, d), (d, b)):
        share = max(0, min(1, dot(minus(q, p), minus(a, p)) / dot(minus(q, p), minus(q, p))))
        off = [x - share * y for x, y in zip(minus(a, p), minus(q, p))]
        sizes.append(dot(off, off))
    volume, *others = facts(True, a, b, c, d)
    is_over = all(side >= 0 for side in others[3:6])
    return volume**2 / dot(others[:3], others[:3]) if is_over else min(sizes)


def told(text):
    """Returns the least and the greatest time that the text allows: equal times for a fraction,
    10^-30 apart for sqrt(3), a unit of the last digit apart for a decimal. None, None for free."""
    if "Exact: free" in text:
        return None, None
    word = re.search(r"Exact: .*?t = (sqrt\(3\)|[\d./]+(?<=\d)(?:e-\d+)?)", text)[1]
    if "sqrt" in word:
        time = Fraction(math.isqrt(3 * 10**60), 10**30) - 1
        return time, time + Fraction(1, 10**30)
    digits = re.search(r"\.(\d+)(?:e-(\d+))?", word)
    close = Fraction(1, 2 * 10**(len(digits[1]) + int(digits[2] or 0))) if digits else 0
    return Fraction(word) - close, Fraction(word) + close


def stated_of_set():
    """Returns a map from the points of each query of the set to its first time (two doubles)."""
    cases = [case for file in sorted(VECTORS.glob("*-findings.json"))
             for case in json.loads(file.read_text())["cases"] if "t0" in case]
    return {points_key(c["t0"], c["t1"]): tuple(map(Fraction, c.get("first_time", ()))) for c in cases}


def points_key(x0, x1):
    return tuple(sorted(tuple(map(float, [*a, *b])) for a, b in zip(x0, x1)))


def is_mesh_right(name, first=None):
    """Returns whether each step has its stated first time, and the first step the time `first`."""
    case = json.loads((MESHES / f"{name}.json").read_text())
    for i, step in enumerate(case["expected"]["steps"]):
        times = mesh_contacts(case["triangles"], *case["frames"][i:i + 2])
        stated = map(Fraction, step["first_time"]) if "first_time" in step else (None, None)
        if not begin(times, *stated) or (first and i == 0 and not begin(times, *first)):
            return False
    return True


def points_of(text):
    """Returns a bool (whether the text names a vertex and a face), and the points at t = 0 and
    at t = 1. A query has four points; a vertex comes first."""
    given = re.search(r"(?:Input:|\*\*,) ((?:edges|a [fv]).*?)(?:Answers|:| of a triangle)", text)
    point = r"\(([^(),]*),([^(),]*),([^(),]*)\)"
    points = re.findall(f"{point}(?: to {point})?", given[1]) if given else []
    if given and given[1].startswith("a face"):
        points = points[-1:] + points[:-1]
    x0, x1 = ([[float(c or d) for c, d in zip(p[k:k + 3], p)] for p in points] for k in (0, 3))
    return bool(given) and "face" in given[1], x0, x1


def has_points(name, x0, x1):
    """Returns whether the mesh has all of these points."""
    frames = json.loads((MESHES / f"{name}.json").read_text())["frames"]
    return set(points_key(x0, x1)) <= set(points_key(*frames[:2]))


def is_right(finding, stated):
    text = " ".join(finding.split())
    first, within = told(text), "_within" in text
    named = re.findall(r"(?:NAME|MESH) (\w+)", text)
    mesh = [name for name in named if (MESHES / f"{name}.json").exists()][-1:]
    is_face, x0, x1 = points_of(text)
    if mesh and not (is_mesh_right(mesh[0], None if within else first) and
                     has_points(mesh[0], x0, x1)):
        return False
    if len(x0) != 4:
        return bool(mesh)
    exact = stated.get(points_key(x0, x1))
    if within:
        # The face rests: the distance is convex in time, so it falls to a thousandth once.
        before, after = (square(*points_at(t, x0, x1)) for t in exact)
        told_right = all(lo <= hi for lo, hi in zip((first[0], exact[0]), (exact[1], first[1])))
        return before > Fraction(0.001)**2 > after and told_right
    if exact is None and not mesh and first[0] != first[1]:
        return False  # only its digits tell the time
    times = contacts(is_face, x0, x1)
    return begin(times, *first) and (not exact or begin(times, *exact))


def main():
    page = (HERE / "FINDINGS.md").read_text()
    findings = [f for f in re.split(r"\n(?=(?:- )?\*\*|## )", page) if "**" in f and "Exact:" in f]
    stated = stated_of_set()
    results = [(re.search(r"\*\*(.*?)\*\*", f)[1], is_right(f, stated)) for f in findings]
    results += [(m.name, is_mesh_right(m.stem)) for m in sorted(MESHES.glob("*.json"))]
    for name, result in results:
        print("confirmed" if result else "REFUTED", name)
    is_long = [f for f in findings if len(f.split()) > MOST_WORDS]
    print(*("too many words: " + f for f in is_long), sep="\n")
    pages = [page, *((HERE / up / "README.md").read_text() for up in ("", "../.."))]
    is_counted = all(f"{len(findings)} wrong answers" in " ".join(p.split()) for p in pages)
    return is_long or not is_counted or not all(right for _, right in results)


if __name__ == "__main__":
    sys.exit(1 if main() else 0)
