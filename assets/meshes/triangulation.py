"""Irregular triangulations of the plane for the scripts beside this one, and meshes as OBJ.

Points are drawn at random, none nearer than NEAREST of the edge length to another, joined by
Delaunay's rule and moved towards the middle of their neighbours a few times.
"""
import math
import sys

NEAREST = 0.7  # of two random points, in edges
JITTER = 0.1  # of the places along borders, in edges
LAST_MISSES = 3000  # in a row, after which no place is thought to be left


class Delaunay:
    """Bowyer-Watson: triangles as corners, and for each directed side the triangle left of it.
    `edge` is about the distance of neighbours."""

    def __init__(self, points, edge):
        far = 100 * max(max(abs(x), abs(y)) for x, y in points)
        self.n = len(points)
        self.edge = edge
        self.points = points + [(-far, -far), (far, -far), (0.0, far)]
        self.left = {}  # (a, b) -> c, the corner of the triangle a b c
        self.last = (self.n, self.n + 1)
        self.add(self.n, self.n + 1, self.n + 2)
        for p in sorted(range(self.n), key=self.strip):
            self.insert(p)

    def strip(self, p):
        """Points in narrow strips, up and down, so that each is near the one before it."""
        x, y = self.points[p]
        column = math.floor(x / (3 * self.edge))
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


def random_points(rng, edge, fixed, draw, copies=lambda x, y: [(x, y)]):
    """Darts that hit no disc around an earlier one or a fixed point, until many in a row do.

    draw    gives a place, or None for a miss
    copies  of a place: itself and where else it counts
    """
    size = NEAREST * edge
    grid = {}

    def is_free(x, y):
        i, j = math.floor(x / size), math.floor(y / size)
        return all(math.hypot(x - px, y - py) >= size
                   for di in (-1, 0, 1) for dj in (-1, 0, 1)
                   for px, py in grid.get((i + di, j + dj), ()))

    def put(x, y):
        for px, py in copies(x, y):
            grid.setdefault((math.floor(px / size), math.floor(py / size)), []).append((px, py))

    for point in fixed:
        put(*point)
    points = []
    misses = 0
    while misses < LAST_MISSES:
        place = draw()
        misses += 1
        if place is not None and is_free(*place):
            put(*place)
            points.append(place)
            misses = 0
    return points


def in_order(triangles):
    """Each from its lowest corner on, sorted."""
    return sorted(t[t.index(min(t)):] + t[:t.index(min(t))] for t in triangles)


def smoothed(points, n_fixed, places, triangles):
    """Every point after the fixed ones in the middle of its neighbours. `triangles` are of
    `places`, of which the first are the points."""
    n = len(points)
    sums = [[0.0, 0.0, 0] for _ in points]
    for t in triangles:
        for v in t:
            for w in t:
                if v < n and w != v:
                    sums[v][0] += places[w][0]
                    sums[v][1] += places[w][1]
                    sums[v][2] += 1
    return points[:n_fixed] + [(x / k, y / k) for x, y, k in sums[n_fixed:]]


def smallest_angle(places, triangles):
    """In degrees; places in the plane or in space."""
    smallest = math.pi
    for t in triangles:
        for k in range(3):
            a, b, c = (places[t[(k + m) % 3]] for m in range(3))
            u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
            cosine = sum(p * q for p, q in zip(u, v)) / (math.hypot(*u) * math.hypot(*v))
            smallest = min(smallest, math.acos(cosine))
    return math.degrees(smallest)


def print_counts(n_vertices, triangles, published, angle):
    """To stderr. `triangles` by vertices; `published` is what the source's mesh is said to have."""
    edges = {tuple(sorted((t[k], t[k - 1]))) for t in triangles for k in range(3)}
    counts = f"{n_vertices} vertices, {len(triangles)} triangles"
    print(f"{counts}, {len(edges)} edges (published: {published}), "
          f"smallest angle {angle:.1f} degrees", file=sys.stderr)


def loop(vertices):
    """A closed line through vertices, counted from 0, as OBJ has it."""
    return "l " + " ".join(str(v + 1) for v in [*vertices, vertices[0]])


def print_obj(comment, positions, textures, corners, groups):
    """corners  of each triangle, (vertex, texture) counted from 0
    groups   name -> lines of OBJ that give it its vertices"""
    lines = ["# " + comment]
    lines += ["v %.6f %.6f %.6f" % p for p in positions]
    lines += ["vt %.6f %.6f" % p for p in textures]
    lines += ["f " + " ".join(f"{v + 1}/{t + 1}" for v, t in triangle) for triangle in corners]
    for name, elements in groups.items():
        lines += ["g " + name, *elements]
    print("\n".join(lines).replace("-0.000000", "0.000000"))
