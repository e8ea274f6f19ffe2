"""A villa of three rooms in a row, 24 x 3.4 x 9 m, with windows to the south (+Z): 11 luminaires of 760 shining triangles, of five
colours. Under an overcast sky there is daylight too."""

import math

from gltf import Mesh, Scene

SHINE = [(5000, 3500, 2200), (4200, 4200, 4200), (2600, 4000, 5200), (5200, 2600, 3400), (3600, 4800, 2600)]


def drum(mesh, material, x, y, z, radius, height, sides):
    """A luminaire of 4 triangles a side: rims above and below, and the mantle."""
    for i in range(sides):
        a, b = 2 * math.pi * i / sides, 2 * math.pi * (i + 1) / sides
        p, q = (x + radius * math.cos(a), z + radius * math.sin(a)), (x + radius * math.cos(b), z + radius * math.sin(b))
        mesh.polygon(material, (x, y + height, z), (q[0], y + height, q[1]), (p[0], y + height, p[1]))
        mesh.polygon(material, (x, y, z), (p[0], y, p[1]), (q[0], y, q[1]))
        mesh.polygon(material, (p[0], y, p[1]), (p[0], y + height, p[1]), (q[0], y + height, q[1]), (q[0], y, q[1]))


def build():
    scene = Scene()
    scene.paint("floor", (0.42, 0.36, 0.3))
    scene.paint("ceiling", 0.8)
    scene.paint("wall", (0.72, 0.71, 0.68))
    scene.paint("red wall", (0.6, 0.16, 0.1))
    scene.paint("green chair", (0.2, 0.42, 0.16))
    scene.paint("yellow", (0.75, 0.6, 0.12))
    scene.paint("wood", (0.45, 0.3, 0.18))
    scene.paint("stone", 0.52)
    scene.paint("frame", 0.15)
    for i, shine in enumerate(SHINE):
        scene.paint(f"lamp {i}", 0, shine=shine)
    house = Mesh()
    house.polygon("floor", (0, 0, 0), (0, 0, 9), (24, 0, 9), (24, 0, 0))
    house.polygon("ceiling", (0, 3.4, 0), (24, 3.4, 0), (24, 3.4, 9), (0, 3.4, 9))
    house.polygon("wall", (0, 0, 0), (24, 0, 0), (24, 3.4, 0), (0, 3.4, 0))
    house.polygon("red wall", (0, 0, 9), (0, 0, 0), (0, 3.4, 0), (0, 3.4, 9))
    house.polygon("wall", (24, 0, 0), (24, 0, 9), (24, 3.4, 9), (24, 3.4, 0))
    windows = [(2 * i + 0.4, 2 * i + 1.6, 0.9, 2.6, 0) for i in range(12)]
    house.wall("wall", (24, 0, 9), (-1, 0, 0), (0, 1, 0), 24, 3.4, 0.3, windows)
    for i in range(12):
        for x in (2 * i + 1.0,):
            house.box("frame", (x - 0.02, 0.9, 9.1), (x + 0.02, 2.6, 9.14))
    for x in (8, 16):  # walls between the rooms, each with a door that has an arch
        house.wall("wall", (x, 0, 9), (0, 0, -1), (0, 1, 0), 9, 3.4, 0.2, [(1.0, 2.2, 0, 1.7, 0.6), (6.0, 7.6, 0, 2.2, 0)], 16)
    # Furniture: tables with chairs, round stools, a stair, plants' pots, shelves.
    def table(x, z):
        house.revolve("wood", [(0.0, 0.72), (0.7, 0.72), (0.7, 0.76), (0.0, 0.76)], (x, 0, z), 40)
        house.revolve("frame", lambda v: (0.28 * (1 - v) ** 3 + 0.04, 0.72 * v), (x, 0, z), 24, 16)
        for k in range(4):
            a = math.pi * (k / 2 + 0.25)
            cx, cz = x + 1.05 * math.cos(a), z + 1.05 * math.sin(a)
            house.revolve("green chair", lambda v: (0.05 + 0.2 * v ** 3, 0.42 * v), (cx, 0, cz), 20, 10)
            house.revolve("green chair", [(0.25, 0.42), (0.25, 0.47), (0.0, 0.47)], (cx, 0, cz), 20)

            def back(u, v, a=a, cx=cx, cz=cz):
                b = a + 1.1 * (2 * u - 1)
                return (cx + 0.25 * math.cos(b), 0.47 + 0.4 * v * math.sin(math.pi * (0.15 + 0.7 * u)), cz + 0.25 * math.sin(b))

            house.surface("green chair", back, 12, 4)
            house.surface("green chair", lambda u, v, f=back: tuple(p + d for p, d in zip(f(u, v), (0, 0, 0.002))), 12, 4, flip=True)

    for x, z in ((4, 4.5), (12, 3.2), (12, 6.4), (20, 4.5)):
        table(x, z)
    for i in range(9):
        house.box("stone", (14.2 + 0.2 * i, 0, 0.1), (15.9, 0.18 * (i + 1), 1.3), without="y")
    for x, z in ((0.7, 0.7), (7.4, 8.3), (8.8, 8.3), (23.3, 0.7), (16.7, 8.3)):
        house.revolve("stone", lambda v: (0.18 + 0.1 * v + 0.04 * math.sin(9 * v), 0.6 * v), (x, 0, z), 32, 24)
        house.revolve("green chair", lambda v: (0.45 * math.sin(math.pi * v) * (1 + 0.2 * math.sin(20 * v)), 0.6 + 1.0 * v), (x, 0, z), 32, 40)
    for k in range(4):
        house.box("wood", (18, 0.4 + 0.5 * k, 0.02), (22, 0.44 + 0.5 * k, 0.35))
        for i in range(20):
            house.box("yellow" if (3 * i + k) % 4 else "red wall", (18.1 + 0.19 * i, 0.44 + 0.5 * k, 0.06), (18.22 + 0.19 * i, 0.68 + 0.5 * k + 0.02 * (i % 3), 0.3))
    scene.add("house", house)
    # Ten lamps of 17 sides and one of 20: 760 triangles.
    where = [(2, 2.5), (2, 6.5), (6, 2.5), (6, 6.5), (12, 3.2), (12, 6.4), (10, 1.5), (18, 2.5), (18, 6.5), (22, 2.5), (21, 6.5)]
    for i, (x, z) in enumerate(where):
        lamp = Mesh()
        drum(lamp, f"lamp {i % 5}", x, 2.5, z, 0.3, 0.14, 20 if i == 10 else 17)
        scene.add(f"lamp {i}", lamp)
    scene.camera("main", (0.8, 2.2, 7.6), (9, 0.9, 3.2), 60)
    scene.camera("chair", (13.9, 1.7, 4.9), (12.4, 0.4, 3.6), 50)
    scene.camera("plant", (6.0, 1.9, 6.9), (7.4, 0.3, 8.3), 50)
    return scene
