#!/usr/bin/env python3
"""Writes skirt.obj: a half-circle skirt, closed at the back, as an irregular mesh.

    python3 assets/meshes/make_skirt.py > assets/meshes/skirt.obj

The pattern is half a ring, flat. Its two straight edges, x = 0, are sewn together at the back, by
which it rolls into a cone without stretching: a point at distance r from the ring's centre comes to
lie r/2 from the axis. Positions are on the cone, y up, waist at 1 m; texture coordinates are places
in the pattern [m], the first along the grain, which runs down the middle of the front.

The ring's other half is the same half turned by 180 degrees, so that the seam is inside of the ring
that is triangulated.
"""
import math
import random
import sys

import triangulation

WAIST = 0.70  # circumference [m]
LENGTH = 0.55  # from waist to hem, along the cloth [m]
WAIST_HEIGHT = 1.0  # [m]
ROUNDS = 3  # of smoothing

R0 = WAIST / math.pi  # of the waist in the pattern [m]
R1 = R0 + LENGTH


def turned(places):
    return [(-x, -y) for x, y in places]


def half_ring(points, n_waist, edge):
    """Triangles of the half x >= 0 of the ring of points and their opposites, as corners in
    0 ... 2n - 1. A triangle of three waist points lies in the ring's hole."""
    n = len(points)
    both = points + turned(points)
    triangles = []
    for t in triangulation.Delaunay(both, edge).triangles():
        if all(v % n < n_waist for v in t) or sum(both[v][0] for v in t) < 0:
            continue
        assert all(both[v][0] >= 0 for v in t), "a triangle crosses the seam"
        triangles.append(t)
    return both, triangulation.in_order(triangles)


class Skirt:
    """Points in the pattern, those of waist, hem and seam first, and their triangles (half_ring).
    Waist and hem go from seam to seam without the end.

    edge  aimed at [m]
    """

    def __init__(self, edge, seed):
        self.edge = edge
        rng = random.Random(seed)
        arcs = [[(r * math.sin(math.pi * s), -r * math.cos(math.pi * s))
                 for s in triangulation.jittered(rng, round(math.pi * r / edge))[:-1]]
                for r in (R0, R1)]
        seam = [(0.0, -(R0 + LENGTH * s))
                for s in triangulation.jittered(rng, round(LENGTH / edge))[1:-1]]
        fixed = arcs[0] + arcs[1] + seam
        self.n_waist = len(arcs[0])
        self.n_fixed = len(fixed)
        self.hem = range(self.n_waist, self.n_waist + len(arcs[1]))
        self.points = fixed + triangulation.random_points(
            rng, edge, fixed, lambda: self.draw(rng), lambda x, y: [(x, y), (-x, -y)])

    def draw(self, rng):
        r = math.sqrt(rng.uniform(R0 * R0, R1 * R1))
        angle = rng.uniform(-math.pi / 2, math.pi / 2)
        x, y = r * math.cos(angle), r * math.sin(angle)
        return (x, y) if min(r - R0, R1 - r, x) >= triangulation.NEAREST * self.edge else None

    def smooth(self):
        for _ in range(ROUNDS):
            both, triangles = half_ring(self.points, self.n_waist, self.edge)
            self.points = triangulation.smoothed(self.points, self.n_fixed, both, triangles)
        self.both, self.triangles = half_ring(self.points, self.n_waist, self.edge)

    def positions(self):
        return [on_cone(*p) for p in self.points]

    def vertices(self):
        """Of each triangle, once the seam is sewn."""
        return [tuple(v % len(self.points) for v in t) for t in self.triangles]

    def print_obj(self, comment, further_groups):
        # A vertex on the seam has two places in the pattern.
        places = sorted({v for t in self.triangles for v in t})
        number = {v: k for k, v in enumerate(places)}
        n = len(self.points)
        corners = [[(v % n, number[v]) for v in t] for t in self.triangles]
        groups = {"waist": [triangulation.loop(range(self.n_waist))],
                  "hem": [triangulation.loop(self.hem)], **further_groups}
        triangulation.print_obj(comment, self.positions(), [self.both[v] for v in places], corners,
                                groups)


def on_cone(x, y):
    r, angle = math.hypot(x, y), 2 * math.atan2(y, x)
    height = WAIST_HEIGHT - (r - R0) * math.sqrt(3) / 2
    return r / 2 * math.sin(angle), height, r / 2 * math.cos(angle)


def main():
    skirt = Skirt(edge=0.021, seed=20240)
    skirt.smooth()
    print(f"{len(skirt.points)} vertices, {len(skirt.triangles)} triangles, smallest angle "
          f"{triangulation.smallest_angle(skirt.both, skirt.triangles):.1f} degrees",
          file=sys.stderr)
    skirt.print_obj("A half-circle skirt, written by make_skirt.py. Lengths in metres.", {})


if __name__ == "__main__":
    main()
