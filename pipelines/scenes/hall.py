"""An open court of 30 x 12 m between two storeys of arcades: columns, arches, vaulted galleries; two lamps, the sky's side open."""

import math

from gltf import Mesh, Scene

BAYS, BAY = 8, 3.0  # along the court; five across
LONG, WIDE, DEEP = BAYS * BAY, 12.0, 3.0  # the court, and the galleries about it
STOREYS = (5.0, 4.5)


def column(mesh, x, y, z, height, thick):
    """A square plinth, a base of two rings, a shaft that tapers, a capital under a square slab."""
    mesh.box("stone", (x - 1.5 * thick, y, z - 1.5 * thick), (x + 1.5 * thick, y + 0.2, z + 1.5 * thick), without="y")

    def shaft(v):
        h = v * (height - 0.4)
        r = thick * (1 - 0.15 * v)
        if v < 0.06:
            r += 0.3 * thick * abs(math.cos(math.pi * v / 0.04))
        elif v > 0.88:
            r += 0.5 * thick * ((v - 0.88) / 0.12) ** 2
        return r, 0.2 + h

    mesh.revolve("stone", shaft, (x, y, z), 16, 22)
    mesh.box("stone", (x - 1.5 * thick, y + height - 0.2, z - 1.5 * thick), (x + 1.5 * thick, y + height, z + 1.5 * thick), without="Y")


def build():
    scene = Scene()
    scene.paint("floor", (0.5, 0.46, 0.4))
    scene.paint("wall", (0.66, 0.58, 0.46))
    scene.paint("stone", (0.6, 0.56, 0.5))
    scene.paint("vault", (0.7, 0.62, 0.5))
    scene.paint("cloth red", (0.55, 0.1, 0.07))
    scene.paint("cloth green", (0.12, 0.38, 0.14))
    scene.paint("cloth blue", (0.1, 0.16, 0.45))
    scene.paint("lamp of the sky", 0, shine=(1600, 1790, 2150))
    scene.paint("warm lamp", 0, shine=(10700, 8600, 5400))
    mesh = Mesh()
    mesh.polygon("floor", (-LONG / 2 - DEEP, 0, WIDE / 2 + DEEP), (LONG / 2 + DEEP, 0, WIDE / 2 + DEEP),
                 (LONG / 2 + DEEP, 0, -WIDE / 2 - DEEP), (-LONG / 2 - DEEP, 0, -WIDE / 2 - DEEP))
    floor = 0.0
    for storey, height in enumerate(STOREYS):
        spring, thick = height - 2.1, 0.32 if storey == 0 else 0.24
        low = 0.0 if storey == 0 else 1.0
        # Arcades to the court, on all four sides; above the columns stands an arch of each bay.
        sides = [
            ((-LONG / 2, floor, -WIDE / 2), (1, 0, 0), LONG), ((LONG / 2, floor, WIDE / 2), (-1, 0, 0), LONG),
            ((-LONG / 2, floor, WIDE / 2), (0, 0, -1), WIDE), ((LONG / 2, floor, -WIDE / 2), (0, 0, 1), WIDE),
        ]
        for origin, along, length in sides:
            count = round(length / BAY)
            arches = [(BAY * i + 0.3, BAY * (i + 1) - 0.3, 0, 0, 1.2) for i in range(count)]
            above = (origin[0], floor + spring, origin[2])
            mesh.wall("wall", above, along, (0, 1, 0), length, height - spring, 0.45, arches, 16)
            deep = (-along[2], 0, along[0])  # away from the court: -(along x up)
            deep = (along[2], 0, -along[0]) if origin[2] * deep[2] + origin[0] * deep[0] < 0 else deep
            for i in range(count + 1):
                x = origin[0] + along[0] * BAY * i + deep[0] * 0.22
                z = origin[2] + along[2] * BAY * i + deep[2] * 0.22
                column(mesh, x, floor, z, spring, thick)
            if low:  # a balustrade
                for i in range(count):
                    for k in range(6):
                        t = BAY * i + 0.5 + k * 0.4
                        x, z = origin[0] + along[0] * t + deep[0] * 0.22, origin[2] + along[2] * t + deep[2] * 0.22
                        mesh.revolve("stone", lambda v: (0.05 + 0.04 * math.sin(math.pi * v) ** 2, 0.8 * v), (x, floor, z), 8, 6)
                    a = [origin[0] + along[0] * (BAY * i + 0.3), origin[2] + along[2] * (BAY * i + 0.3)]
                    b = [origin[0] + along[0] * (BAY * (i + 1) - 0.3) + deep[0] * 0.45, origin[2] + along[2] * (BAY * (i + 1) - 0.3) + deep[2] * 0.45]
                    mesh.box("stone", (min(a[0], b[0]), floor + 0.8, min(a[1], b[1])), (max(a[0], b[0]), floor + 0.95, max(a[1], b[1])))
        # Vaults over the galleries: a barrel of each bay, seen from below; and the storey's floor above them.
        top = floor + height
        for sign in (-1, 1):
            for i in range(BAYS):
                x0 = -LONG / 2 + BAY * i

                def vault(u, v, x0=x0, sign=sign, top=top):
                    return (x0 + BAY * v, top - 1.2 + 1.1 * math.sin(math.pi * v) ** 0.5 if 0 < v < 1 else top - 1.2,
                            sign * (WIDE / 2 + 0.45 + (DEEP - 0.45) * u))

                mesh.surface("vault", vault, 1, 12, flip=sign < 0)
        outer = (LONG / 2 + DEEP, WIDE / 2 + DEEP)
        for x0, x1, z0, z1 in ((-outer[0], outer[0], -outer[1], -WIDE / 2), (-outer[0], outer[0], WIDE / 2, outer[1]),
                               (-outer[0], -LONG / 2, -WIDE / 2, WIDE / 2), (LONG / 2, outer[0], -WIDE / 2, WIDE / 2)):
            mesh.box("floor", (x0, top - 0.05, z0), (x1, top, z1))
        # Walls behind the galleries, with doors below and windows' niches above.
        mesh.box("wall", (-outer[0], floor, -outer[1]), (outer[0], top - 0.05, outer[1]), inward=True, without="yY")
        floor = top
    # Cloths that hang from the upper storey.
    for i, name in enumerate(("red", "green", "blue", "red", "green", "blue")):
        for sign in (-1, 1):
            x0 = -LONG / 2 + BAY * (i + 1) + 0.5

            def cloth(u, v, x0=x0, sign=sign):
                return (x0 + 2 * u, 6.5 - 3.2 * v, sign * (WIDE / 2 - 0.3 - 0.12 * math.sin(6 * math.pi * u) * v))

            mesh.surface(f"cloth {name}", cloth, 24, 8, flip=sign < 0)
            mesh.surface(f"cloth {name}", lambda u, v, c=cloth, s=sign: tuple(a + b for a, b in zip(c(u, v), (0, 0, 0.01 * s))), 24, 8, flip=sign > 0)
    mesh.polygon("lamp of the sky", (-4, 11.5, -1.5), (4, 11.5, -1.5), (4, 11.5, 1.5), (-4, 11.5, 1.5))
    mesh.polygon("warm lamp", (-12, 4.2, -1.2), (-10.8, 4.2, -1.2), (-10.8, 4.2, 0), (-12, 4.2, 0))
    scene.add("court", mesh)
    scene.camera("main", (-10.5, 7.4, 0.2), (4, 3.4, -0.6), 60)
    scene.camera("floor", (-11, 1.7, 0.6), (2, 3.2, -0.6), 62)
    scene.camera("gallery", (-11.5, 1.8, -7.4), (4, 1.9, -7.0), 60)
    return scene
