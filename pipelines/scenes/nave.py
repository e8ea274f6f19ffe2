"""A nave of 36 x 9 m and 16 m height between two aisles, with pointed arches, ribs, rose window and a round apse; two lamps."""

import math

from gltf import Mesh, Scene

BAYS, BAY, HALF, AISLE = 7, 5.0, 4.5, 4.0
SPRING, CROWN, LOW = 11.0, 16.0, 7.0  # of the nave's vault; height of the aisles
LONG = BAYS * BAY


def pointed(t, half, rise):
    """Height over its springing of a pointed arch at t from -1 to 1, `half` its half width."""
    # Two arcs about points beyond the middle, chosen so that they meet at `rise`.
    radius = (half * half + rise * rise) / (2 * half)
    x = radius - half + half * abs(t)
    return math.sqrt(max(0.0, radius * radius - x * x))


def build():
    scene = Scene()
    scene.paint("stone", (0.62, 0.58, 0.52))
    scene.paint("floor", (0.42, 0.36, 0.32))
    scene.paint("carpet", (0.5, 0.12, 0.1))
    scene.paint("rib", (0.55, 0.5, 0.44))
    scene.paint("wood", (0.33, 0.2, 0.11))
    scene.paint("lamp of the nave", 0, shine=(13400, 12500, 10700))
    scene.paint("lamp of the choir", 0, shine=(19700, 18800, 17000))
    mesh = Mesh()
    x0, x1, side = -LONG / 2, LONG / 2, HALF + AISLE
    mesh.polygon("floor", (x0, 0, side), (x1 + 5, 0, side), (x1 + 5, 0, -side), (x0, 0, -side))
    mesh.polygon("carpet", (x0 + 2, 0.01, 0.9), (x1, 0.01, 0.9), (x1, 0.01, -0.9), (x0 + 2, 0.01, -0.9))
    # The nave's walls: an arch to the aisle, and a window's niche above, in each bay.
    for sign in (-1, 1):
        origin, along = ((x0, 0, -HALF), (1, 0, 0)) if sign < 0 else ((x1, 0, HALF), (-1, 0, 0))
        arches = [(BAY * i + 0.7, BAY * (i + 1) - 0.7, 0, 3.8, 2.4) for i in range(BAYS)]
        mesh.wall("stone", origin, along, (0, 1, 0), LONG, LOW, 0.7, arches, 20)
        niches = [(BAY * i + 1.6, BAY * (i + 1) - 1.6, 0.8, 2.6, 0.9) for i in range(BAYS)]
        mesh.wall("stone", (origin[0], LOW, origin[2]), along, (0, 1, 0), LONG, SPRING - LOW, 0.5, niches, 12)
        mesh.polygon("stone", *((x0, LOW, sign * (HALF + 0.5)), (x1, LOW, sign * (HALF + 0.5)), (x1, SPRING, sign * (HALF + 0.5)),
                                (x0, SPRING, sign * (HALF + 0.5)))[:: 1 if sign < 0 else -1])
        # The aisle: its wall, and its barrel vault.
        mesh.polygon("stone", *((x0, 0, sign * side), (x1, 0, sign * side), (x1, LOW, sign * side), (x0, LOW, sign * side))[:: 1 if sign < 0 else -1])
        mesh.surface("stone", lambda u, v, s=sign: (x0 + LONG * u, 6.3 + 0.65 * math.sin(math.pi * v) if 0 < v < 1 else 6.3,
                                                    s * (HALF + 0.7 + (AISLE - 0.7) * v)), 14, 16, flip=sign < 0)
        # Piers: a bundle of shafts that go up to the vault.
        for i in range(BAYS + 1):
            x = x0 + BAY * i
            for k in range(5):
                a = math.pi * (k + 0.5) / 5
                r = 0.16 if k != 2 else 0.22
                mesh.revolve("rib", lambda v, r=r: (r * (1.6 - 0.6 * min(1, v * 20)) if v < 0.95 else r * (1 + 10 * (v - 0.95)), SPRING * v),
                             (x + 0.45 * math.cos(a), 0, sign * (HALF - 0.05 - 0.2 * math.sin(a))), 10, 30)
            # The transverse rib.
            if 0 < i < BAYS and sign < 0:
                def rib(v, x=x):
                    t = 2 * v - 1
                    return (x, SPRING - 0.1 + pointed(t, 1.0, 1.0) * (CROWN - SPRING), HALF * t)

                mesh.tube("rib", rib, 0.2, 8, 32)
        # Pews.
        for i in range(12):
            x, z = x0 + 5 + 1.4 * i, sign * 2.6
            mesh.box("wood", (x, 0.42, z - 1.4), (x + 0.4, 0.47, z + 1.4))
            mesh.box("wood", (x - 0.05, 0, z - 1.4), (x, 0.9, z + 1.4))
            for e in (-1.4, 1.36):
                mesh.box("wood", (x, 0, z + e), (x + 0.4, 0.42, z + e + 0.04), without="yY")
    # The vault: pointed across, and lower towards the middle of each bay's cross vault.
    def vault(u, v):
        t = 2 * v - 1
        cross_vault = 0.5 - 0.5 * math.cos(2 * math.pi * (u * BAYS % 1))
        lift = pointed(t, 1.0, 1.0) * (CROWN - SPRING)
        return (x0 + LONG * u, SPRING + max(lift, 0.85 * (CROWN - SPRING) * cross_vault * abs(t) ** 1.5), HALF * t)

    mesh.surface("stone", vault, 16 * BAYS, 32)
    for sign in (-1, 1):  # the wall under the ends of the cross vaults
        mesh.surface("stone", lambda u, v, s=sign: (x0 + LONG * u, SPRING + v * (vault(u, 0)[1] - SPRING), s * HALF), 16 * BAYS, 1, flip=sign > 0)
    # West: a wall with a rose of rings and spokes. East: the apse, half a round, under half a dome.
    mesh.polygon("stone", (x0, 0, side), (x0, 0, -side), (x0, LOW, -side), (x0, LOW, side))
    mesh.polygon("stone", (x0, LOW, HALF), (x0, LOW, -HALF), (x0, CROWN, -HALF), (x0, CROWN, HALF))
    for r in (0.9, 1.6, 2.3):
        mesh.tube("rib", lambda v, r=r: (x0 + 0.1, 11.4 + r * math.cos(2 * math.pi * v), r * math.sin(2 * math.pi * v)), 0.1, 8, 48)
    for k in range(12):
        a = 2 * math.pi * k / 12
        mesh.tube("rib", lambda v, a=a: (x0 + 0.1, 11.4 + (0.3 + 2 * v) * math.cos(a), (0.3 + 2 * v) * math.sin(a)), 0.06, 6, 4)
    mesh.surface("stone", lambda u, v: (x1 + HALF * math.sin(math.pi * u), 9.5 * v, -HALF * math.cos(math.pi * u)), 32, 6)
    mesh.surface("stone", lambda u, v: (x1 + HALF * math.cos(math.pi / 2 * v) * math.sin(math.pi * u), 9.5 + 4.2 * math.sin(math.pi / 2 * v),
                                        -HALF * math.cos(math.pi / 2 * v) * math.cos(math.pi * u)), 32, 16)
    for sign in (-1, 1):  # what is left of the east wall, beside the apse and above it
        mesh.polygon("stone", *((x1, 0, sign * HALF), (x1, 0, sign * side), (x1, LOW, sign * side), (x1, LOW, sign * HALF))[:: sign])
        mesh.surface("stone", lambda u, v, s=sign: (x1, 9.5 + 4.2 * math.sin(math.pi / 2 * u) * (1 - v) + (CROWN - 9.5) * v,
                                                    s * HALF * (math.cos(math.pi / 2 * u) * (1 - v) + (1 - u) * v)), 12, 4, flip=sign < 0)
    mesh.box("stone", (x1 + 0.5, 0, -1.2), (x1 + 1.6, 1.1, 1.2))
    for z in (-0.8, 0, 0.8):
        mesh.revolve("rib", lambda v: (0.05 + 0.04 * math.cos(6 * math.pi * v) ** 2, 0.7 * v), (x1 + 1, 1.1, z), 12, 24)
    mesh.polygon("lamp of the nave", (-7.75, 10, -0.75), (-6.25, 10, -0.75), (-6.25, 10, 0.75), (-7.75, 10, 0.75))
    mesh.polygon("lamp of the choir", (11.25, 10, -0.75), (12.75, 10, -0.75), (12.75, 10, 0.75), (11.25, 10, 0.75))
    scene.add("nave", mesh)
    scene.camera("nave", (-16.5, 2.6, 0.8), (6, 6.2, -0.4), 58)
    scene.camera("aisle", (-15, 2.2, 6.2), (6, 3.2, 5.4), 60)
    scene.camera("choir", (13, 6, 0), (-6, 5.6, 0.2), 60)
    return scene
