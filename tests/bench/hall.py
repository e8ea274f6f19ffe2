"""Writes a hall with many lamps: hall.py OUTPUT.obj (and .mtl and .lights.json beside it)

24 x 6 x 12 m, six windows to the south (+Z), eight columns, six tables; ten hanging lamps of five colours, each a drum of 76
triangles. Cameras: hall, all of it; table and column, close to a table's and a column's foot with their shadows.
"""

import json
import math
import sys

output = sys.argv[1]
stem = output.rsplit(".", 1)[0]
vertices, faces = [], []


def face(material, *corners):
    first = len(vertices) + 1
    vertices.extend(corners)
    faces.append((material, [first + i for i in range(len(corners))]))


def box(material, lo, hi):
    (x, y, z), (u, v, w) = lo, hi
    face(material, (x, y, z), (x, y, w), (x, v, w), (x, v, z))
    face(material, (u, y, z), (u, v, z), (u, v, w), (u, y, w))
    face(material, (x, y, z), (u, y, z), (u, y, w), (x, y, w))
    face(material, (x, v, z), (x, v, w), (u, v, w), (u, v, z))
    face(material, (x, y, z), (x, v, z), (u, v, z), (u, y, z))
    face(material, (x, y, w), (u, y, w), (u, v, w), (x, v, w))


def drum(material, x, y, z, radius=0.4, height=0.15, sides=19):
    at = [2 * math.pi * i / sides for i in range(sides + 1)]
    ring = [(x + radius * math.cos(a), z + radius * math.sin(a)) for a in at]
    for (ax, az), (bx, bz) in zip(ring, ring[1:]):
        top, low = y + height, y
        face(material, (x, top, z), (bx, top, bz), (ax, top, az))
        face(material, (x, low, z), (ax, low, az), (bx, low, bz))
        face(material, (ax, low, az), (ax, top, az), (bx, top, bz))
        face(material, (ax, low, az), (bx, top, bz), (bx, low, bz))


# The room, seen from within; the wall to the south is what the windows leave of it.
face("floor", (0, 0, 0), (0, 0, 12), (24, 0, 12), (24, 0, 0))
face("ceiling", (0, 6, 0), (24, 6, 0), (24, 6, 12), (0, 6, 12))
face("wall", (0, 0, 0), (24, 0, 0), (24, 6, 0), (0, 6, 0))
face("red", (0, 0, 0), (0, 6, 0), (0, 6, 12), (0, 0, 12))
face("wall", (24, 0, 0), (24, 0, 12), (24, 6, 12), (24, 6, 0))


def south(x, y, u, v):
    face("wall", (x, y, 12), (x, v, 12), (u, v, 12), (u, y, 12))


south(0, 0, 24, 1.2)
south(0, 4.2, 24, 6)
edges = [0] + [x for i in range(6) for x in (4 * i + 1, 4 * i + 3)] + [24]
for left, right in zip(edges[::2], edges[1::2]):
    south(left, 1.2, right, 4.2)

for i in range(4):
    for z in (3, 9):
        x = 3 + 6 * i
        box("stone", (x - 0.25, 0, z - 0.25), (x + 0.25, 6, z + 0.25))
for i in range(3):
    for z in (5, 7):
        x = 6 + 6 * i
        box("wood", (x - 1, 0.72, z - 0.4), (x + 1, 0.76, z + 0.4))
        for dx in (-0.9, 0.84):
            for dz in (-0.34, 0.28):
                box("wood", (x + dx, 0, z + dz), (x + dx + 0.06, 0.72, z + dz + 0.06))
for i in range(5):
    for k, z in enumerate((4, 8)):
        drum(f"lamp{i}{k}", 2.4 + 4.8 * i, 3.6, z)

colours = {"floor": (0.4, 0.38, 0.35), "ceiling": (0.8, 0.8, 0.8), "wall": (0.7, 0.7, 0.68), "red": (0.6, 0.15, 0.1)}
colours |= {"stone": (0.5, 0.5, 0.52), "wood": (0.45, 0.3, 0.18)}
shine = [(5000, 3500, 2200), (4200, 4200, 4200), (2600, 4000, 5200), (5200, 2600, 3400), (3600, 4800, 2600)]
with open(stem + ".mtl", "w") as file:
    for name, kd in colours.items():
        print(f"newmtl {name}\nKd {kd[0]} {kd[1]} {kd[2]}", file=file)
    for name, ke in ((f"lamp{i}{k}", ke) for i, ke in enumerate(shine) for k in (0, 1)):
        print(f"newmtl {name}\nKd 0 0 0\nKe {ke[0]} {ke[1]} {ke[2]}", file=file)
with open(output, "w") as file:
    print("mtllib", stem.rsplit("/", 1)[-1] + ".mtl", file=file)
    for v in vertices:
        print("v", *(f"{c:.6g}" for c in v), file=file)
    material = None
    for name, corners in faces:
        if name != material:
            print("usemtl", name, file=file)
        material = name
        print("f", *corners, file=file)
look = {
    "hall": ((0.8, 2.4, 6.2), (14, 1.4, 5.4)),
    "table": ((9, 1.9, 8.6), (11.6, 0.3, 6.6)),
    "column": ((13.2, 1.6, 4.6), (15.2, 0.5, 2.6)),
}
cameras = [{"name": n, "eye": e, "target": t, "yfov_deg": 55, "aspect": 4 / 3} for n, (e, t) in look.items()]
with open(stem + ".lights.json", "w") as file:
    json.dump({"cameras": cameras}, file)
