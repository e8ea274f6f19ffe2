"""Writes a hall of many lamps: lamp_hall.py OUTPUT.obj LAMPS (and .mtl and .lights.json beside it)

60 x 8 x 30 m, five partitions of 5 m height with a door of 4 m each; point lamps on a grid 7 m above the floor, each of 1 to 3 parts of
20,000 cd / LAMPS. For phos-sense, which reads more than 1000 lamps by a cut through their hierarchy.
"""

import json
import math
import random
import sys

output, lamps = sys.argv[1], int(sys.argv[2])
stem = output.rsplit(".", 1)[0]
vertices, faces = [], []


def face(*corners):
    first = len(vertices) + 1
    vertices.extend(corners)
    faces.append([first + i for i in range(len(corners))])


face((0, 0, 0), (0, 0, 30), (60, 0, 30), (60, 0, 0))
face((0, 8, 0), (60, 8, 0), (60, 8, 30), (0, 8, 30))
for x in (0, 60):
    face((x, 0, 0), (x, 8, 0), (x, 8, 30), (x, 0, 30))
for z in (0, 30):
    face((0, 0, z), (60, 0, z), (60, 8, z), (0, 8, z))
for x in range(10, 60, 10):
    for at in (x, x + 0.1):
        face((at, 0, 0), (at, 0, 26), (at, 5, 26), (at, 5, 0))

across = max(1, round(math.sqrt(lamps / 2)))
along = -(-lamps // across)
draw = random.Random(1)
lights = [
    {
        "kind": "point",
        "name": f"lamp {i}",
        "position": [60 * (i // across + 0.5) / along, 7, 30 * (i % across + 0.5) / across],
        "intensity": [20000 * (1 + 2 * draw.random()) / lamps] * 3,
    }
    for i in range(lamps)
]

with open(output, "w") as file:
    name = stem.rsplit("/", 1)[-1]
    file.write(f"mtllib {name}.mtl\no hall\nusemtl wall\n")
    for v in vertices:
        file.write("v {:g} {:g} {:g}\n".format(*v))
    for f in faces:
        file.write("f " + " ".join(map(str, f)) + "\n")
with open(stem + ".mtl", "w") as file:
    file.write("newmtl wall\nKd 0.5 0.5 0.5\n")
with open(stem + ".lights.json", "w") as file:
    json.dump({"lights": lights}, file)
