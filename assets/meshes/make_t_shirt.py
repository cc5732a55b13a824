#!/usr/bin/env python3
"""Writes t_shirt.obj: a T-shirt with sleeves as an irregular mesh.

    python3 assets/meshes/make_t_shirt.py > assets/meshes/t_shirt.obj

Front and back are the same flat panel, sewn together along shoulders and upper sleeves and along
lower sleeves and sides. Where they meet, the cloth rounds from front to back in half a circle of
radius ROUNDING, without stretching but where the seam is curved: the panel's point at distance d
from the seam comes to lie ROUNDING (1 - cos(d/ROUNDING)) from it and ROUNDING sin(d/ROUNDING) in
front of it. Further inside, the panels are flat: a shirt laid on a table with some air in it, and
stood up.

Positions are in metres, y up, front towards z, neck points near y = 1.42 m; texture coordinates are
places in the panels [m], the first downward along the grain, the back 1 m beside the front. Left
and right are the wearer's.
"""
import math
import random

import triangulation

HALF_WIDTH = 0.26  # of a panel at chest and hem [m]
LENGTH = 0.72  # from the neck points down to the hem [m]
NECK = 0.09  # radius of the half circle cut out [m]
SLEEVE = 0.37  # from neck point to cuff along the shoulder [m]
CUFF = 0.19  # half of its way around [m]
SLOPE = math.radians(20)  # of shoulder and sleeve
ARMPIT = 0.05  # radius of the curve between sleeve and side [m]
ROUNDING = 0.05  # [m]; pi/2 of it, twice, fits into the cuff
NECK_HEIGHT = 1.45  # of the panel's neck points before rounding [m]
BACK = 1.0  # of the back's texture from the front's [m]

EDGE = 0.0249  # aimed at [m]
SEED = 1  # the first from 1 on that gives 1714 vertices
ROUNDS = 3  # of smoothing

# Unit vectors along the sleeve, away from the body, and across it, from shoulder to lower seam.
ALONG = math.cos(SLOPE), -math.sin(SLOPE)
ACROSS = -math.sin(SLOPE), -math.cos(SLOPE)


def shoulder(s, across):
    """The place so far along the shoulder and below it."""
    return NECK + s * ALONG[0] + across * ACROSS[0], s * ALONG[1] + across * ACROSS[1]


# The armpit's curve lies around a point so far from the lower seam and from the side, both lines.
CENTRE_X = HALF_WIDTH + ARMPIT
CENTRE_S = (CENTRE_X - NECK - (CUFF + ARMPIT) * ACROSS[0]) / ALONG[0]
CENTRE = shoulder(CENTRE_S, CUFF + ARMPIT)


def from_upper_seam(x, y):
    """Distance from the seam inward and the unit vector inward. For x >= 0."""
    return (x - NECK) * ACROSS[0] + y * ACROSS[1], ACROSS


def from_lower_seam(x, y):
    u, v = x - CENTRE[0], y - CENTRE[1]
    if v <= 0:
        return -u - ARMPIT, (-1.0, 0.0)
    if u * ALONG[0] + v * ALONG[1] >= 0:
        return -u * ACROSS[0] - v * ACROSS[1] - ARMPIT, (-ACROSS[0], -ACROSS[1])
    r = math.hypot(u, v)
    return r - ARMPIT, (u / r, v / r)


def depth(x, y):
    """Distance from the panel's outline, negative outside of it."""
    x = abs(x)
    to_cuff = SLEEVE - (x - NECK) * ALONG[0] - y * ALONG[1]
    return min(from_upper_seam(x, y)[0], from_lower_seam(x, y)[0], y + LENGTH,
               math.hypot(x, y) - NECK, to_cuff if y > CENTRE[1] else LENGTH)


def right_outline():
    """What the panel's half x >= 0 is bounded by, from the middle of the hem on: lines as functions
    of a share, with their lengths."""
    x, y = CENTRE
    turn = math.pi / 2 - SLOPE  # of the armpit's curve

    def line(a, b):
        return lambda s: (a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])), math.dist(a, b)

    def lower_seam(s):
        """Side, armpit and sleeve in one."""
        along = s * lower_length
        if along < side:
            return HALF_WIDTH, along - LENGTH
        if along < side + ARMPIT * turn:
            angle = math.pi - (along - side) / ARMPIT
            return x + ARMPIT * math.cos(angle), y + ARMPIT * math.sin(angle)
        return shoulder(CENTRE_S + along - side - ARMPIT * turn, CUFF)

    def neck(s):
        return NECK * math.cos(s * math.pi / 2), -NECK * math.sin(s * math.pi / 2)

    side = y + LENGTH
    lower_length = side + ARMPIT * turn + SLEEVE - CENTRE_S
    return {"hem": line((0.0, -LENGTH), (HALF_WIDTH, -LENGTH)),
            "lower_seam": (lower_seam, lower_length),
            "cuff": line(shoulder(SLEEVE, CUFF), shoulder(SLEEVE, 0.0)),
            "upper_seam": line(shoulder(SLEEVE, 0.0), (NECK, 0.0)),
            "neck": (neck, NECK * math.pi / 2)}


class Panel:
    """Points, those of the outline first, and where on it they lie: chains of vertices, each with
    both ends, by name. Those on the right go around, from the middle of the hem to that of the
    neck; the left ones are their mirror images."""

    def __init__(self, seed):
        rng = random.Random(seed)
        self.points = []
        self.chains = {}
        last = None
        for name, (place, length) in right_outline().items():
            shares = triangulation.jittered(rng, round(length / EDGE))
            chain = [] if last is None else [last]
            for s in shares[0 if last is None else 1:]:
                chain.append(len(self.points))
                self.points.append(place(s))
            self.chains["right_" + name] = chain
            last = chain[-1]
        mirror = {}
        for v, (x, y) in enumerate(list(self.points)):
            if abs(x) < 1e-9:
                self.points[v] = (0.0, y)
                mirror[v] = v
            else:
                mirror[v] = len(self.points)
                self.points.append((-x, y))
        for name, chain in list(self.chains.items()):
            self.chains[name.replace("right", "left")] = [mirror[v] for v in chain]
        self.n_fixed = len(self.points)
        self.seam = {v for name, chain in self.chains.items() if "seam" in name for v in chain}
        self.points += triangulation.random_points(rng, EDGE, self.points, lambda: self.draw(rng))

    def draw(self, rng):
        right = shoulder(SLEEVE, 0.0)[0]
        place = rng.uniform(-right, right), rng.uniform(-LENGTH, 0.0)
        return place if depth(*place) >= triangulation.NEAREST * EDGE else None

    def n_vertices(self):
        """Of the shirt."""
        return 2 * len(self.points) - len(self.seam)

    def triangles(self):
        def is_inside(t):
            return depth(*(sum(self.points[v][k] for v in t) / 3 for k in (0, 1))) > 1e-3 * EDGE

        found = triangulation.Delaunay(self.points, EDGE).triangles()
        return triangulation.in_order([t for t in found if is_inside(t)])

    def smooth(self):
        for _ in range(ROUNDS):
            self.points = triangulation.smoothed(self.points, self.n_fixed, self.points,
                                                 self.triangles())


def rounded(x, y):
    """The place of the front's point."""
    place = [abs(x), y]
    front = ROUNDING
    for distance, inward in from_upper_seam(abs(x), y), from_lower_seam(abs(x), y):
        angle = min(distance / ROUNDING, math.pi / 2)
        moved = ROUNDING * (math.pi / 2 - angle - math.cos(angle))
        place = [p + moved * q for p, q in zip(place, inward)]
        front *= math.sin(angle)
    return math.copysign(place[0], x), place[1] + NECK_HEIGHT, front


def main():
    panel = Panel(SEED)
    assert panel.n_vertices() == 1714, panel.n_vertices()
    panel.smooth()
    n = len(panel.points)
    triangles = panel.triangles()
    assert len(triangles) == 2 * n - panel.n_fixed - 2, "the panel is no whole disc"
    # The back's vertex of each of the front's, and its texture after all of the front's.
    behind = {v: v for v in panel.seam}
    behind.update({v: n + k for k, v in enumerate(v for v in range(n) if v not in panel.seam)})
    front = [rounded(*p) for p in panel.points]
    positions = front + [(x, y, -z) for v, (x, y, z) in enumerate(front) if v not in panel.seam]
    textures = [(-y, x) for x, y in panel.points] + [(-y, BACK - x) for x, y in panel.points]
    corners = [[(v, v) for v in t] for t in triangles]
    corners += [[(behind[v], n + v) for v in (a, c, b)] for a, b, c in triangles]

    groups = {}
    chains = panel.chains
    # In the panel's picture the right is the wearer's left.
    for name, half in (("neck", chains["left_neck"] + chains["right_neck"][-2::-1]),
                       ("hem", chains["left_hem"][::-1] + chains["right_hem"][1:]),
                       ("left_sleeve", chains["right_cuff"]),
                       ("right_sleeve", chains["left_cuff"])):
        back = [behind[v] for v in half]
        ring = half + [v for v in back[::-1] if v not in half]
        groups[name] = [triangulation.loop(ring)]
    vertices = [tuple(v for v, _ in t) for t in corners]
    triangulation.print_counts(len(positions), vertices, "1714, 3296, 10024 half-edges",
                               triangulation.smallest_angle(positions, vertices))
    triangulation.print_obj("A T-shirt, written by make_t_shirt.py. Lengths in metres.", positions,
                            textures, corners, groups)


if __name__ == "__main__":
    main()
