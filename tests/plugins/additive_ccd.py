"""additive_ccd.cpp in Python: while two features are apart, time advances by an interval in which they
cannot meet, and then their distance is measured again. It is the detector of reports/check/TEN_MINUTES.md,
with the fault that is mended there."""

from math import sqrt


def plus(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def times(s, a):
    return s * a[0], s * a[1], s * a[2]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def length(a):
    return sqrt(dot(a, a))


def share(part, whole):
    return min(max(part / whole, 0.0), 1.0) if whole > 0 else 0.0


def between_segments(p):
    """Returns the distance of the segments p0 p1 and p2 p3."""
    a, b, gap = minus(p[1], p[0]), minus(p[3], p[2]), minus(p[0], p[2])
    bb, ab, bg = dot(b, b), dot(a, b), dot(b, gap)
    n = cross(a, b)  # for nearly parallel edges aa * bb - ab * ab is only rounding error
    s = share(dot(n, cross(b, gap)), dot(n, n))
    u = share(ab * s + bg, bb)
    return length(minus(plus(gap, times(s, a)), times(u, b)))


def to_triangle(p):
    """Returns the distance of the point p0 and the triangle p1 p2 p3."""
    least = 1e300
    n = cross(minus(p[2], p[1]), minus(p[3], p[1]))
    is_inside = dot(n, n) > 0
    for i in (1, 2, 3):
        edge, q = minus(p[i % 3 + 1], p[i]), minus(p[0], p[i])
        is_inside = is_inside and dot(cross(n, edge), q) >= 0
        least = min(least, length(minus(q, times(share(dot(q, edge), dot(edge, edge)), edge))))
    return min(least, abs(dot(n, minus(p[0], p[1]))) / length(n)) if is_inside else least


class AdditiveCcd:
    name, version = "my CCD", "1.0"
    claims = ["free-sound", "not-late", "total"]
    contract = {"least_nonzero": 1e-50, "largest": 1e50}  # so that fourth powers neither overflow nor vanish

    @staticmethod
    def query(kind, x_t0, x_t1):
        start = [tuple(x) for x in x_t0.tolist()]
        way = [minus(x, y) for x, y in zip(x_t1.tolist(), start)]
        mean = (0.0, 0.0, 0.0)  # the motion that all four share brings them no nearer
        for w in way:
            mean = plus(mean, times(0.25, w))
        firsts = 1 if kind == "vertex-face" else 2  # points of the first feature
        speeds = [length(minus(w, mean)) for w in way]
        speed = max(speeds[:firsts]) + max(speeds[firsts:])
        size = max(length(x) + length(w) for x, w in zip(start, way))
        nearly = 1e-9 * size  # more than the rounding errors below
        t = 0.0
        for _ in range(1000):
            now = [plus(x, times(t, w)) for x, w in zip(start, way)]
            apart = to_triangle(now) if firsts == 1 else between_segments(now)
            if apart <= nearly:
                return {"first": (t, 1.0)}
            if speed == 0:
                return None
            following = t + 0.9 * apart / speed
            if following > 1:
                return None
            t = following
        return {"first": (t, 1.0)}  # perhaps a false alarm, which is safe
