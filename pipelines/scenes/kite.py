"""A kite that flies through a room of 6 x 3.2 x 5 m for 300 frames: high at first, where it changes little; then it comes down into the
beam of a lamp near the floor, and throws coloured light on ceiling and wall."""

import math

from gltf import Mesh, Scene, turn


def build():
    scene = Scene(frames=300, fps=25)
    scene.paint("floor", (0.5, 0.42, 0.32))
    scene.paint("tile", (0.3, 0.24, 0.18))
    scene.paint("wall", (0.72, 0.7, 0.66))
    scene.paint("ceiling", 0.8)
    scene.paint("stripe", (0.3, 0.4, 0.55))
    scene.paint("shade", 0.05)
    scene.paint("kite red", (0.8, 0.12, 0.08))
    scene.paint("kite yellow", (0.85, 0.65, 0.1))
    scene.paint("bow", (0.1, 0.3, 0.7))
    scene.paint("wood", (0.4, 0.26, 0.14))
    scene.paint("lamp", 0, shine=(9000, 8400, 7400))
    scene.paint("spot", 0, shine=(60000, 56000, 48000))
    room = Mesh()
    for i in range(24):  # tiles of two colours
        for k in range(20):
            x, z = 0.25 * i, 0.25 * k
            room.polygon("floor" if (i + k) % 2 else "tile", (x, 0, z), (x, 0, z + 0.25), (x + 0.25, 0, z + 0.25), (x + 0.25, 0, z))
    room.polygon("ceiling", (0, 3.2, 0), (6, 3.2, 0), (6, 3.2, 5), (0, 3.2, 5))
    room.box("wall", (0, 1.1, 0), (6, 3.2, 5), inward=True, without="yY")
    for k in range(60):  # stripes below
        room.polygon("stripe" if k % 2 else "wall", (0.1 * k, 0, 0), (0.1 * k + 0.1, 0, 0), (0.1 * k + 0.1, 1.1, 0), (0.1 * k, 1.1, 0))
    room.box("wall", (0, 0, 0), (6, 1.1, 5), inward=True, without="yYz")
    # A vase, a chest with knobs, a globe.
    room.revolve("bow", lambda v: (0.12 + 0.12 * math.sin(3.6 * v) ** 2 * (1 - 0.4 * v), 0.7 * v), (0.7, 0, 0.7), 48, 48)
    room.box("wood", (4.6, 0, 0.05), (5.8, 0.8, 0.6), without="y")
    for i in range(3):
        for k in range(2):
            room.revolve("tile", lambda v: (0.03 * math.sin(math.pi * v), 0.06 * v - 0.03), (4.9 + 0.35 * i, 0.3 + 0.3 * k, 0.62), 24, 16)
    room.revolve("stripe", lambda v: (0.22 * math.sin(math.pi * v), 0.22 - 0.22 * math.cos(math.pi * v)), (5.2, 0.8, 0.32), 64, 48)
    # Two lamps: one under the ceiling, and one in a shade on the floor that shines up past the kite's lowest place.
    room.polygon("lamp", (2.6, 3.19, 2.1), (3.4, 3.19, 2.1), (3.4, 3.19, 2.9), (2.6, 3.19, 2.9))
    room.revolve("shade", [(0.2, 0.0), (0.2, 0.4)], (3.0, 0, 2.2), 32)
    room.revolve("shade", [(0.19, 0.4), (0.19, 0.0)], (3.0, 0, 2.2), 32)
    room.polygon("spot", (2.88, 0.02, 2.32), (3.12, 0.02, 2.32), (3.12, 0.02, 2.08), (2.88, 0.02, 2.08))
    scene.add("room", room)
    # The kite: two sails that bulge, its spars, and a tail of bows.
    kite = Mesh()
    for sign, name in ((-1, "kite red"), (1, "kite yellow")):
        def sail(u, v, s=sign):
            half = 0.42 * (v / 0.7 if v < 0.7 else (1 - v) / 0.3)
            return (s * u * half, 1.1 * v - 0.7, 0.08 * math.sin(math.pi * u) * math.sin(math.pi * v))

        kite.surface(name, sail, 32, 48, flip=sign < 0)
        kite.surface(name, lambda u, v, f=sail: (f(u, v)[0], f(u, v)[1], f(u, v)[2] - 0.004), 32, 48, flip=sign > 0)
    kite.tube("wood", lambda v: (0, 1.1 * v - 0.7, -0.01), 0.008, 8, 8)
    kite.tube("wood", lambda v: (0.84 * v - 0.42, 0.07, -0.012), 0.008, 8, 8)
    for i in range(6):
        y, x = -0.85 - 0.16 * i, 0.06 * math.sin(1.7 * i)
        for sign in (-1, 1):
            kite.revolve("bow", lambda v, s=sign: (0.03 * math.sin(math.pi * v), 0.1 * v - 0.05), (x + 0.05 * sign, y, 0), 12, 8)
    kite.tube("wood", lambda v: (0.06 * math.sin(8 * v), -0.7 - 1.0 * v, 0), 0.004, 6, 40)
    node = scene.add("kite", kite)

    def at(frame):
        t = frame / 299
        down = 0.5 - 0.5 * math.cos(math.pi * min(1.0, max(0.0, (t - 0.35) / 0.45)))
        sway = 2 * math.pi * t
        return (2.9 + 0.9 * math.sin(2 * sway) * (1 - 0.6 * down), 2.35 - 0.9 * down + 0.05 * math.sin(9 * sway), 1.5 + 0.7 * down + 0.2 * math.sin(3 * sway))

    scene.move(node, "translation", at)

    def pose(frame):
        t = frame / 299
        down = 0.5 - 0.5 * math.cos(math.pi * min(1.0, max(0.0, (t - 0.35) / 0.45)))
        return turn((1, 0.25 * math.sin(12 * t), 0.3 * math.sin(7 * t)), 20 + 45 * down + 6 * math.sin(30 * t))

    scene.move(node, "rotation", pose)
    scene.camera("main", (3, 1.5, 4.9), (3, 1.45, 1), 60)
    return scene
