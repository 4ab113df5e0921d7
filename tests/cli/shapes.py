"""Small inputs for the tests: points and meshes with known parts, made from fixed seeds."""

import math
import random


def sphere_point(generator):
    z = generator.uniform(-1.0, 1.0)
    angle = generator.uniform(0.0, 2.0 * math.pi)
    radius = math.sqrt(1.0 - z * z)
    return radius * math.cos(angle), radius * math.sin(angle), z


def dumbbell(count=4000, seed=1):
    """Surface of two overlapping unit balls around (-0.85, 0, 0) and (0.85, 0, 0)."""
    generator = random.Random(seed)
    points = []
    while len(points) < count:
        x, y, z = sphere_point(generator)
        side = -0.85 if generator.random() < 0.5 else 0.85
        x += side
        if (x + side) ** 2 + y * y + z * z >= 1.0:  # not inside the other ball
            points.append((x, y, z))
    return points


def plane(count=500, seed=2):
    generator = random.Random(seed)
    return [(generator.random(), generator.random(), 0.0) for _ in range(count)]


def octahedron_sphere(center, rounds=3):
    """Vertices and triangles of a refined octahedron on the unit sphere around `center`."""
    corners = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)]
    triangles = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4),
                 (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(rounds):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                x = [corners[a][i] + corners[b][i] for i in range(3)]
                length = math.sqrt(sum(v * v for v in x))
                middles[key] = len(corners)
                corners.append(tuple(v / length for v in x))
            return middles[key]

        for a, b, c in triangles:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
        triangles = finer
    return [tuple(p[i] + center[i] for i in range(3)) for p in corners], triangles


def xyz(points):
    return "".join(f"{x:.17g} {y:.17g} {z:.17g}\n" for x, y, z in points)


def off(vertices, triangles):
    faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in triangles)
    return f"OFF\n{len(vertices)} {len(triangles)} 0\n{xyz(vertices)}{faces}"
