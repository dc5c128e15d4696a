"""Exact facts of two moving features, in whole numbers: whether they cross or only touch, and
polynomials whose zeros include the first time of contact. oracle/query/contact_events.h defines
coplanarity, sides and gaps, and calls them F, L and D; this file computes them in another way.

A polynomial c0 + c1 t + ... is a list of whole numbers: [c0, c1, ...].
"""
import itertools
import math
from fractions import Fraction

from vectors import has_zero, primitive, remainder, sign_at, sturm_chain, zeros_between


def plus(p, q, factor=1):
    return [a + factor * b for a, b in itertools.zip_longest(p, q, fillvalue=0)]


def times(p, q):
    product = [0] * (len(p) + len(q) - 1)
    for (i, a), (j, b) in itertools.product(enumerate(p), enumerate(q)):
        product[i + j] += a * b
    return product


def minus(u, v):
    return [plus(a, b, -1) for a, b in zip(u, v)]


def dot(u, v):
    return plus(plus(times(u[0], v[0]), times(u[1], v[1])), times(u[2], v[2]))


def cross(u, v):
    return [plus(times(u[i - 2], v[i - 1]), times(u[i - 1], v[i - 2]), -1) for i in range(3)]


def derivative(p):
    return [i * c for i, c in enumerate(p)][1:]


class Time:
    """The only zero of a polynomial between lo and hi; if lo and hi are equal, the number lo."""

    def __init__(self, polynomial, lo, hi):
        self.lo, self.hi = Fraction(lo), Fraction(hi)
        self.chain = sturm_chain(polynomial)

    def sign(self, q):
        """Returns the sign of the polynomial q at this time."""
        a, b = self.chain[0], primitive(q)
        while b:
            a, b = b, remainder(a, b)
        if self.lo < self.hi and len(a) > 1 and has_zero(a, self.lo, self.hi):
            return 0  # a zero of both polynomials
        while self.lo < self.hi and has_zero(q, self.lo, self.hi):
            middle = (self.lo + self.hi) / 2
            if sign_at(self.chain[0], middle) == 0:
                self.lo = self.hi = middle
            elif zeros_between(self.chain, self.lo, middle):
                self.hi = middle
            else:
                self.lo = middle
        return sign_at(q, self.lo)


def without(p, t):
    """Returns the polynomial p without its zeros at the time t."""
    p = primitive(p)
    while len(p) > 1 and sign_at(p, t) == 0:
        quotient = list(itertools.accumulate(p[::-1], lambda above, c: above * t + c))[-2::-1]
        scale = math.lcm(*(c.denominator for c in quotient))
        p = primitive([int(c * scale) for c in quotient])
    return p


def vanishes_within(p, lo, hi):
    """Returns whether p has a zero strictly between lo and hi, or at lo if lo and hi are equal."""
    lo, hi = Fraction(lo), Fraction(hi)
    return sign_at(p, lo) == 0 if lo == hi else has_zero(without(without(p, lo), hi), lo, hi)


def zeros_inside(p):
    """Returns the zeros of p in (0, 1). REQUIRES that not all coefficients are 0."""
    p = without(without(p, Fraction(0)), Fraction(1))
    chain, found, left = sturm_chain(p), [], [(Fraction(0), Fraction(1))]
    while left:
        lo, hi = left.pop()
        count = zeros_between(chain, lo, hi)
        if count == 1:
            found.append(Time(p, lo, hi))
        elif count:
            inner = (lo + (hi - lo) * k / (len(p) + 1) for k in range(1, len(p) + 1))
            middle = next(m for m in inner if sign_at(p, m) != 0)
            left += [(lo, middle), (middle, hi)]
    return found


class Features:
    def __init__(self, first, t0, t1):
        self.first, self.t0, self.t1 = first, t0, t1
        exact = [[[Fraction(x) for x in p] for p in end] for end in (t0, t1)]
        self.scale = max(x.denominator for end in exact for p in end for x in p)
        self.x = [[[int(a * self.scale), int((b - a) * self.scale)] for a, b in zip(p, q)]
                  for p, q in zip(*exact)]
        u = [minus(x, self.x[0]) for x in self.x[1:]]
        n = [cross(u[1], u[2]), cross(u[2], u[0]), cross(u[0], u[1])]
        self.coplanarity = dot(u[0], n[0])
        self.sides = []
        for l1, l2, l3 in zip(*n):
            of_first = plus(plus(l1, l2), l3)
            signs = (-1, 1 if first == 2 else -1, -1, -1)
            self.sides.append([[s * c for c in p] for s, p in zip(signs, (of_first, l1, l2, l3))])
        self.gaps = [[plus(a[k], b[k], -1) for a in self.x[:first] for b in self.x[first:]]
                     for k in range(3)]

    def events(self):
        """Returns polynomials; the first time of a contact is a zero of one of them."""
        if any(self.coplanarity):
            return [self.coplanarity]
        for polynomials in self.sides + self.gaps:
            if any(map(any, polynomials)):
                return [[0, 1]] + [p for p in polynomials if any(p)]
        return [[0, 1]]

    def meets(self, time):
        """Returns whether the features meet at `time`. REQUIRES coplanar points then."""
        for sides in self.sides:
            signs = {time.sign(p) for p in sides} - {0}
            if signs:
                return len(signs) == 1
        for gaps in self.gaps:
            signs = {time.sign(p) for p in gaps}
            if signs != {0}:
                return len(signs) > 1
        return True

    def passes(self):
        """Returns whether the features meet inside the step while F changes its sign."""
        f, slope = self.coplanarity, derivative(self.coplanarity)
        return any((time.sign(slope) or not time.sign(derivative(slope))) and self.meets(time)
                   for time in (zeros_inside(f) if any(f) else ()))

    def within(self, d):
        """Yields polynomials, simple ones first. One has a zero at the first time within d."""
        square = (Fraction(d) * self.scale) ** 2
        a, b = self.x[:self.first], self.x[self.first:]
        lines = [(p, q, r) for ends, others in ((a, b), (b, a))
                 for p, q in itertools.combinations(ends, 2) for r in others]
        pairs = [(minus(p, q), [[1], [0], [0]]) for p, q in itertools.product(a, b)]
        pairs += [(cross(minus(r, p), minus(q, p)), minus(q, p)) for p, q, r in lines]
        normal = (cross(minus(b[1], b[0]), minus(b[2], b[0])) if self.first == 1 else
                  cross(minus(a[1], a[0]), minus(b[1], b[0])))
        pairs.append(([dot(normal, minus(a[0], b[0])), [0], [0]], normal))
        for u, v in pairs:
            p = plus([c * square.denominator for c in dot(u, u)],
                     [c * square.numerator for c in dot(v, v)], -1)
            if any(p):
                yield p
