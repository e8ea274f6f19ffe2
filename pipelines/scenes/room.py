"""A room of furniture, glossy and not, for 300 frames: a lamp that swings until frame 99, then a ball that rolls under lamps that rest."""

import math

from gltf import Mesh, Scene, turn


def build():
    scene = Scene(frames=300, fps=25)
    scene.paint("wall", (0.7, 0.68, 0.62))
    scene.paint("ceiling", 0.8)
    scene.paint("mat", (0.55, 0.5, 0.34))
    scene.paint("paper", (0.78, 0.76, 0.7))
    scene.paint("frame", (0.2, 0.11, 0.06))
    scene.paint("cushion", (0.5, 0.1, 0.12))
    scene.paint("lacquer", (0.12, 0.03, 0.02), ks=0.45, exponent=18)
    scene.paint("glaze", (0.1, 0.2, 0.3), ks=0.4, exponent=12)
    scene.paint("bronze", (0.05, 0.04, 0.02), ks=(0.6, 0.45, 0.25), exponent=15)
    scene.paint("brushed steel", 0.05, ks=0.5, ax=0.45, ay=0.45)
    scene.paint("shade", (0.6, 0.55, 0.45))
    scene.paint("lamp", 0, shine=(26000, 22000, 15000))
    scene.paint("panel", 0, shine=(3600, 3600, 3400))
    room = Mesh()
    room.polygon("ceiling", (0, 2.8, 0), (6, 2.8, 0), (6, 2.8, 5), (0, 2.8, 5))
    room.box("wall", (0, 0, 0), (6, 2.8, 5), inward=True, without="yYz")
    for i in range(3):  # mats with borders
        for k in range(2):
            x, z = 2 * i, 2.5 * k
            room.polygon("mat", (x + 0.06, 0, z + 0.02), (x + 0.06, 0, z + 2.48), (x + 1.94, 0, z + 2.48), (x + 1.94, 0, z + 0.02))
            for a in (x, x + 1.94):
                room.polygon("frame", (a, 0, z + 0.02), (a, 0, z + 2.48), (a + 0.06, 0, z + 2.48), (a + 0.06, 0, z + 0.02))
            for c in (z, z + 2.48):
                room.polygon("frame", (x, 0, c), (x, 0, c + 0.02), (x + 2, 0, c + 0.02), (x + 2, 0, c))
    # Screens of paper in frames before the back wall.
    room.polygon("paper", (0, 0, 0), (6, 0, 0), (6, 2.8, 0), (0, 2.8, 0))
    for i in range(25):
        room.box("frame", (0.245 * i, 0, 0), (0.245 * i + (0.06 if i % 6 == 0 else 0.018), 2.2, 0.03))
    for k in range(8):
        room.box("frame", (0, 0.3 * k, 0), (6, 0.3 * k + 0.02, 0.028))
    # A low table with bent legs; on it cups, a pot and a bowl.
    room.box("lacquer", (2.1, 0.36, 1.6), (3.9, 0.42, 2.8))
    for x in (2.2, 3.8):
        for z in (1.7, 2.7):
            room.tube("lacquer", lambda v, x=x, z=z: (x + 0.05 * math.sin(3 * v) * (1 if x > 3 else -1), 0.36 * v, z), lambda v: 0.035 + 0.02 * (1 - v) ** 2, 24, 24)
    for i, (x, z) in enumerate(((2.5, 2.0), (2.6, 2.5), (3.4, 1.9), (3.5, 2.5))):
        room.revolve("glaze", lambda v: (0.026 + 0.03 * v ** 0.5, 0.09 * v), (x, 0.42, z), 40, 16)
        room.revolve("glaze", lambda v: (0.053 - 0.053 * v ** 4, 0.09 - 0.082 * v), (x, 0.42, z), 40, 16)
    room.revolve("bronze", lambda v: (0.14 * math.sin(math.pi * min(1, v * 0.97 + 0.02)) ** 0.7 + 0.004, 0.2 * v), (3.0, 0.42, 2.2), 64, 48)
    room.tube("bronze", lambda v: (3.0 + 0.12 * math.cos(math.pi * v), 0.6 + 0.14 * math.sin(math.pi * v), 2.2), 0.012, 16, 40)
    # Cushions: boxes whose faces bulge.
    for x, z in ((1.5, 2.2), (4.5, 2.2), (3.0, 3.4)):
        def cushion(u, v, x=x, z=z):
            a, b = 2 * u - 1, 2 * v - 1
            return (x + 0.32 * a, 0.04 + 0.1 * (1 - a ** 4) * (1 - b ** 4), z - 0.32 * b)

        room.surface("cushion", cushion, 40, 40)
        room.box("cushion", (x - 0.32, 0, z - 0.32), (x + 0.32, 0.04, z + 0.32), without="yY")
    # A chest of drawers with steel fronts and round handles, and two vases on it.
    room.box("frame", (0.05, 0, 1.2), (0.55, 0.9, 3.4), without="y")
    for i in range(3):
        for k in range(4):
            y, z = 0.06 + 0.28 * i, 1.25 + 0.54 * k
            room.box("brushed steel", (0.55, y, z), (0.565, y + 0.25, z + 0.5), without="x")
            room.tube("bronze", lambda v, y=y, z=z: (0.565 + 0.04 * math.sin(math.pi * v), y + 0.125, z + 0.18 + 0.14 * v), 0.008, 12, 24)
    for z, name in ((1.6, "glaze"), (3.0, "bronze")):
        room.revolve(name, lambda v: (0.06 + 0.09 * math.sin(3.4 * v) ** 2 + 0.03 * v ** 6, 0.45 * v), (0.3, 0.9, z), 64, 64)
    # A stand with a bowl; a shelf with books.
    room.revolve("lacquer", lambda v: (0.16 * (1 - v) ** 2 + 0.03 + 0.15 * v ** 8, 0.7 * v), (5.4, 0, 0.8), 48, 48)
    room.revolve("glaze", lambda v: (0.05 + 0.18 * math.sin(math.pi / 2 * v), 0.14 * v * v), (5.4, 0.7, 0.8), 64, 32)
    for k in range(3):
        room.box("frame", (5.7, 0.5 + 0.45 * k, 1.8), (5.98, 0.53 + 0.45 * k, 3.8))
        for i in range(18):
            z = 1.85 + 0.105 * i
            room.box(("cushion", "paper", "mat", "frame")[(i * 7 + k) % 4], (5.74, 0.53 + 0.45 * k, z), (5.95, 0.75 + 0.45 * k + 0.03 * (i * 5 % 4), z + 0.08))
    room.polygon("panel", (1.0, 2.79, 3.9), (5.0, 2.79, 3.9), (5.0, 2.79, 4.3), (1.0, 2.79, 4.3))
    scene.add("room", room)
    # The lamp hangs 1.2 m below its hook.
    lamp = Mesh()
    lamp.tube("frame", lambda v: (0.001 * v, -1.0 * v, 0), 0.006, 8, 2)
    lamp.revolve("shade", [(0.26, -1.25), (0.1, -1.0)], sides=48)
    lamp.revolve("shade", [(0.095, -1.0), (0.255, -1.25)], sides=48)
    lamp.polygon("lamp", (-0.1, -1.12, -0.1), (0.1, -1.12, -0.1), (0.1, -1.12, 0.1), (-0.1, -1.12, 0.1))
    node = scene.add("lamp", lamp, translation=(3, 2.78, 2.2))
    scene.move(node, "rotation", lambda f: turn((0.3, 0, 1), 14 * math.cos(2 * math.pi * f / 50) * (1 if f < 60 else max(0.0, (99 - f) / 39))))
    ball = Mesh()
    ball.revolve("bronze", lambda v: (0.12 * math.sin(math.pi * v), -0.12 * math.cos(math.pi * v)), sides=64, steps=48)
    node = scene.add("ball", ball)
    scene.move(node, "translation", lambda f: (1.3 + 3.4 * min(1, max(0, (f - 100) / 180)), 0.12, 3.9 - 0.25 * math.sin(0.03 * max(0, f - 100))))
    scene.camera("main", (3, 1.7, 4.9), (2.95, 0.7, 1.4), 58)
    scene.camera("chest", (2.4, 1.3, 3.6), (0.4, 0.8, 2.2), 50)
    return scene
