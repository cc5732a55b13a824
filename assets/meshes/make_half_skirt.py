#!/usr/bin/env python3
"""Writes half_skirt.obj: the skirt of make_skirt.py with 1361 vertices.

    python3 assets/meshes/make_half_skirt.py > assets/meshes/half_skirt.obj

The groups hem_front, hem_back, hem_left and hem_right (the wearer's, who faces z) are what a hand
grasps at a corner of the hem: every vertex within GRASP of it.
"""
import math

import triangulation
from make_skirt import LENGTH, R0, Skirt, on_cone

GRASP = 0.04  # [m], about 5 % of the skirt's width
SEED = 57  # the first from 1 on that gives 1361 vertices
CORNERS = {"hem_front": 0, "hem_left": 45, "hem_back": 90, "hem_right": -45}  # pattern [degrees]


def main():
    skirt = Skirt(edge=0.029, seed=SEED)
    assert len(skirt.points) == 1361, len(skirt.points)
    skirt.smooth()
    groups = {}
    for name, degrees in CORNERS.items():
        angle = math.radians(degrees)
        corner = on_cone((R0 + LENGTH) * math.cos(angle), (R0 + LENGTH) * math.sin(angle))
        near = [v for v, x in enumerate(skirt.positions()) if math.dist(x, corner) <= GRASP]
        groups[name] = ["p " + " ".join(str(v + 1) for v in near)]
    triangulation.print_counts(len(skirt.points), skirt.vertices(), "1361, 2500, 7650 half-edges",
                               triangulation.smallest_angle(skirt.both, skirt.triangles))
    skirt.print_obj("A half-circle skirt, written by make_half_skirt.py. Lengths in metres.",
                    groups)


if __name__ == "__main__":
    main()
