#!/usr/bin/env python3
"""The textbook test in Python: roots by Cardano's formula, and an overlap test at each root."""
import cmath
import sys


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def det(a, b, c):
    return sum(a[i] * (b[i - 2] * c[i - 1] - b[i - 1] * c[i - 2]) for i in range(3))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def overlap(edges, x):
    """Tests features in one plane: the solution of r = s u + w v tells whether they overlap."""
    r, u, v = ((minus(x[2], x[0]), minus(x[1], x[0]), minus(x[2], x[3])) if edges else
               (minus(x[0], x[1]), minus(x[2], x[1]), minus(x[3], x[1])))
    uu, uv, vv = dot(u, u), dot(u, v), dot(v, v)
    if uu * vv == uv * uv:
        return False
    s, w = ((dot(r, a) * ab - dot(r, b) * uv) / (uu * vv - uv * uv)
            for a, b, ab in ((u, v, vv), (v, u, uu)))
    return s >= 0 and w >= 0 and (s <= 1 and w <= 1 if edges else s + w <= 1)


def real_roots(cubic):  # the greatest first
    d, c, b, a = (x / (max(map(abs, cubic)) or 1) for x in cubic)
    if a == 0 and b == 0:
        return [-d / c] if c else []
    if a == 0:
        all_roots = [(-c + sign * cmath.sqrt(c * c - 4 * b * d)) / (2 * b) for sign in (1, -1)]
    else:
        p, q = b * b - 3 * a * c, 2 * b * b * b - 9 * a * b * c + 27 * a * a * d
        square = cmath.sqrt(q * q - 4 * p * p * p)
        u = (max(q + square, q - square, key=abs) / 2) ** (1 / 3)
        turns = [u * cmath.exp(2j * cmath.pi * k / 3) for k in range(3)]
        all_roots = [-(b + z + (p / z if z else 0)) / (3 * a) for z in turns]
    return sorted((t.real for t in all_roots if abs(t.imag) < 1e-9), reverse=True)


print("textbook_cubic 1 Cardano in doubles" if input() else "", flush=True)
for line in sys.stdin:
    word, *numbers = line.split()
    answer = "free" if word in ("vertex-face", "edge-edge") else "unsupported"
    if answer == "free":
        p = [[float(x) for x in numbers[i:i + 3]] for i in range(0, 24, 3)]
        x, v = p[:4], [minus(p[i + 4], p[i]) for i in range(4)]
        ends, c = [[minus(q[i], q[0]) for i in (1, 2, 3)] for q in (x, v)], [0, 0, 0, 0]
        for i in range(8):
            c[(i & 1) + (i >> 1 & 1) + (i >> 2)] += det(*(ends[i >> k & 1][k] for k in range(3)))
        for t in real_roots(c):
            at = [[a + t * b for a, b in zip(*pair)] for pair in zip(x, v)]
            if 0 <= t <= 1 and overlap(word == "edge-edge", at):
                answer = f"collision {t!r}"
    print(answer, flush=True)
