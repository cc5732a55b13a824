#!/usr/bin/env python3
"""Writes skirt.obj: a half-circle skirt, closed at the back, as an irregular mesh.

    python3 assets/meshes/make_skirt.py > assets/meshes/skirt.obj

The pattern is half a ring, flat. Its two straight edges, x = 0, are sewn together at the back, by
which it rolls into a cone without stretching: a point at distance r from the ring's centre comes to
lie r/2 from the axis. Positions are on the cone, y up, waist at 1 m; texture coordinates are places
in the pattern [m], the first along the grain, which runs down the middle of the front.

Points are drawn at random, none nearer than 0.7 of the edge length to another, joined by Delaunay's
rule and moved towards the middle of their neighbours a few times. The ring's other half is the same
half turned by 180 degrees, so that the seam is inside of the ring that is triangulated.
"""
import math
import random
import sys

WAIST = 0.70  # circumference [m]
LENGTH = 0.55  # from waist to hem, along the cloth [m]
WAIST_HEIGHT = 1.0  # [m]
EDGE = 0.021  # aimed at [m]
JITTER = 0.1  # of the places along waist, hem and seam, in edges
NEAREST = 0.7  # of two random points, in edges
ROUNDS = 3  # of smoothing
SEED = 20240

R0 = WAIST / math.pi  # of the waist in the pattern [m]
R1 = R0 + LENGTH


class Delaunay:
    """Bowyer-Watson: triangles as corners, and for each directed side the triangle left of it."""

    def __init__(self, points):
        far = 100 * max(max(abs(x), abs(y)) for x, y in points)
        self.n = len(points)
        self.points = points + [(-far, -far), (far, -far), (0.0, far)]
        self.left = {}  # (a, b) -> c, the corner of the triangle a b c
        self.last = (self.n, self.n + 1)
        self.add(self.n, self.n + 1, self.n + 2)
        for p in sorted(range(self.n), key=self.strip):
            self.insert(p)

    def strip(self, p):
        """Points in narrow strips, up and down, so that each is near the one before it."""
        x, y = self.points[p]
        column = math.floor(x / (3 * EDGE))
        return column, y if column % 2 else -y

    def add(self, a, b, c):
        self.left[a, b], self.left[b, c], self.left[c, a] = c, a, b
        self.last = (a, b)

    def orientation(self, a, b, p):
        (ax, ay), (bx, by), (px, py) = self.points[a], self.points[b], self.points[p]
        return (bx - ax) * (py - ay) - (by - ay) * (px - ax)

    def in_circle(self, a, b, c, p):
        px, py = self.points[p]
        (ax, ay), (bx, by), (cx, cy) = ((x - px, y - py) for x, y in
                                        (self.points[a], self.points[b], self.points[c]))
        aa, bb, cc = ax * ax + ay * ay, bx * bx + by * by, cx * cx + cy * cy
        return ax * (by * cc - bb * cy) - ay * (bx * cc - bb * cx) + aa * (bx * cy - by * cx) > 0

    def around(self, p):
        """The triangle that p lies in."""
        a, b = self.last
        if self.orientation(a, b, p) < 0:
            a, b = b, a
        while True:
            c = self.left[a, b]
            if self.orientation(b, c, p) < 0:
                a, b = c, b
            elif self.orientation(c, a, p) < 0:
                a, b = a, c
            else:
                return a, b, c

    def insert(self, p):
        a, b, c = self.around(p)
        sides = [(a, b), (b, c), (c, a)]
        border = []
        for side in sides:
            del self.left[side]
        while sides:
            a, b = sides.pop()
            c = self.left.get((b, a))
            if c is not None and self.in_circle(b, a, c, p):
                for side in (b, a), (a, c), (c, b):
                    del self.left[side]
                sides += [(a, c), (c, b)]
            else:
                border.append((a, b))
        for a, b in border:
            self.add(a, b, p)

    def triangles(self):
        return [(a, b, c) for (a, b), c in self.left.items()
                if a < b and a < c and max(b, c) < self.n]


def jittered(rng, n):
    """n + 1 shares from 0 to 1, those inside moved a little."""
    return [0.0] + [(k + JITTER * rng.uniform(-1, 1)) / n for k in range(1, n)] + [1.0]


def fixed_points(rng):
    """Waist and hem as lists from seam to seam without the end, then the seam between them."""
    arcs = [[(r * math.sin(math.pi * s), -r * math.cos(math.pi * s))
             for s in jittered(rng, round(math.pi * r / EDGE))[:-1]] for r in (R0, R1)]
    seam = [(0.0, -(R0 + LENGTH * s)) for s in jittered(rng, round(LENGTH / EDGE))[1:-1]]
    return arcs[0], arcs[1], seam


def random_points(rng, fixed):
    """Darts that hit no disc around an earlier one, until 3000 in a row do."""
    size = NEAREST * EDGE
    grid = {}

    def is_free(x, y):
        i, j = math.floor(x / size), math.floor(y / size)
        return all(math.hypot(x - px, y - py) >= size
                   for di in (-1, 0, 1) for dj in (-1, 0, 1)
                   for px, py in grid.get((i + di, j + dj), ()))

    def put(x, y):
        for px, py in ((x, y), (-x, -y)):
            grid.setdefault((math.floor(px / size), math.floor(py / size)), []).append((px, py))

    for point in fixed:
        put(*point)
    points = []
    misses = 0
    while misses < 3000:
        r = math.sqrt(rng.uniform(R0 * R0, R1 * R1))
        angle = rng.uniform(-math.pi / 2, math.pi / 2)
        x, y = r * math.cos(angle), r * math.sin(angle)
        misses += 1
        if min(r - R0, R1 - r, x) >= size and is_free(x, y):
            put(x, y)
            points.append((x, y))
            misses = 0
    return points


def half_ring(points, n_waist):
    """Triangles of the half x >= 0 of the ring of points and their opposites, as corners in
    0 ... 2n - 1. A triangle of three waist points lies in the ring's hole."""
    n = len(points)
    both = points + [(-x, -y) for x, y in points]
    triangles = []
    for t in Delaunay(both).triangles():
        if all(v % n < n_waist for v in t) or sum(both[v][0] for v in t) < 0:
            continue
        assert all(both[v][0] >= 0 for v in t), "a triangle crosses the seam"
        first = t.index(min(t))
        triangles.append(t[first:] + t[:first])
    return both, sorted(triangles)


def smoothed(points, n_fixed, n_waist):
    """Every free point in the middle of its neighbours."""
    n = len(points)
    both, triangles = half_ring(points, n_waist)
    sums = [[0.0, 0.0, 0] for _ in points]
    for t in triangles:
        for v in t:
            for w in t:
                if v < n and w != v:
                    sums[v][0] += both[w][0]
                    sums[v][1] += both[w][1]
                    sums[v][2] += 1
    return points[:n_fixed] + [(x / k, y / k) for x, y, k in sums[n_fixed:]]


def on_cone(x, y):
    r, angle = math.hypot(x, y), 2 * math.atan2(y, x)
    height = WAIST_HEIGHT - (r - R0) * math.sqrt(3) / 2
    return r / 2 * math.sin(angle), height, r / 2 * math.cos(angle)


def smallest_angle(both, triangles):
    smallest = math.pi
    for t in triangles:
        for k in range(3):
            (ax, ay), (bx, by), (cx, cy) = (both[t[(k + m) % 3]] for m in range(3))
            ux, uy, vx, vy = bx - ax, by - ay, cx - ax, cy - ay
            smallest = min(smallest, math.atan2(ux * vy - uy * vx, ux * vx + uy * vy))
    return math.degrees(smallest)


def main():
    rng = random.Random(SEED)
    waist, hem, seam = fixed_points(rng)
    fixed = waist + hem + seam
    points = fixed + random_points(rng, fixed)
    for _ in range(ROUNDS):
        points = smoothed(points, len(fixed), len(waist))
    both, triangles = half_ring(points, len(waist))
    n = len(points)
    # A vertex on the seam has two places in the pattern.
    places = sorted({v for t in triangles for v in t})
    number = {v: k + 1 for k, v in enumerate(places)}
    print(f"{n} vertices, {len(triangles)} triangles, smallest angle "
          f"{smallest_angle(both, triangles):.1f} degrees", file=sys.stderr)

    lines = ["# A half-circle skirt, written by make_skirt.py. Lengths in metres."]
    lines += ["v %.6f %.6f %.6f" % on_cone(*p) for p in points]
    lines += ["vt %.6f %.6f" % both[v] for v in places]
    lines += ["f " + " ".join(f"{v % n + 1}/{number[v]}" for v in t) for t in triangles]
    for name, begin, end in (("waist", 0, len(waist)),
                             ("hem", len(waist), len(waist) + len(hem))):
        lines += ["g " + name, "l " + " ".join(str(v + 1) for v in [*range(begin, end), begin])]
    print("\n".join(lines).replace("-0.000000", "0.000000"))


main()
