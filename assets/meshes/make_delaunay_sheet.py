#!/usr/bin/env python3
"""Writes delaunay_sheet.obj: a sheet of 0.46 m x 0.40 m as an irregular mesh of 329 vertices.

    python3 assets/meshes/make_delaunay_sheet.py > assets/meshes/delaunay_sheet.obj

It lies level about the origin, its long side along x. Texture coordinates are places [m], the first
along the grain, which runs along z.
"""
import random

import triangulation

WIDTH = 0.46  # along x [m]
HEIGHT = 0.40  # along z [m]
EDGE = 0.0282  # aimed at [m]
SEED = 3  # the first from 1 on that gives 329 vertices
ROUNDS = 1  # of smoothing, so that it stays irregular


def sheet_points(seed):
    """Places (z, x), those of the outline first, and how many those are."""
    rng = random.Random(seed)
    corners = [(-HEIGHT / 2, -WIDTH / 2), (HEIGHT / 2, -WIDTH / 2),
               (HEIGHT / 2, WIDTH / 2), (-HEIGHT / 2, WIDTH / 2)]
    fixed = []
    for k, (a, b) in enumerate(corners):
        c, d = corners[(k + 1) % 4]
        for s in triangulation.jittered(rng, round((abs(c - a) + abs(d - b)) / EDGE))[:-1]:
            fixed.append((a + s * (c - a), b + s * (d - b)))
    half = [side / 2 - triangulation.NEAREST * EDGE for side in (HEIGHT, WIDTH)]

    def draw():
        return rng.uniform(-half[0], half[0]), rng.uniform(-half[1], half[1])

    return fixed + triangulation.random_points(rng, EDGE, fixed, draw), len(fixed)


def triangles_of(points):
    """Without those of three points on one side, which rounding makes."""
    def has_area(t):
        return all(len({points[v][k] for v in t}) > 1 for k in (0, 1))

    found = triangulation.Delaunay(points, EDGE).triangles()
    return triangulation.in_order([t for t in found if has_area(t)])


def main():
    points, n_fixed = sheet_points(SEED)
    assert len(points) == 329, len(points)
    for _ in range(ROUNDS):
        points = triangulation.smoothed(points, n_fixed, points, triangles_of(points))
    triangles = triangles_of(points)
    triangulation.print_counts(len(points), triangles, "329",
                               triangulation.smallest_angle(points, triangles))
    corners = [[(v, v) for v in t] for t in triangles]
    triangulation.print_obj(
        "An irregular sheet, written by make_delaunay_sheet.py. Lengths in metres.",
        [(x, 0.0, z) for z, x in points], points, corners, {})


if __name__ == "__main__":
    main()
