"""Martin Newell's teapot of 1975: 28 bicubic Bezier patches, and four of a bottom, of the side `fineness` cells each."""

from gltf import Mesh, Scene

# Newell's quarter circle: its inner control points, in parts of the radius.
ARC = 0.56
# Profiles of the parts that are turned about the vertical axis: radius and height of four control points each, from above to below.
LID = [[(0, 3.15), (0.8, 3.15), (0, 2.85), (0.2, 2.7)], [(0.2, 2.7), (0.4, 2.55), (1.3, 2.55), (1.3, 2.4)]]
RIM = [[(1.4, 2.4), (1.3375, 2.53125), (1.4375, 2.53125), (1.5, 2.4)]]
BODY = [[(1.5, 2.4), (1.75, 1.875), (2, 1.35), (2, 0.9)], [(2, 0.9), (2, 0.45), (1.5, 0.225), (1.5, 0.15)]]
BOTTOM = [[(1.5, 0.15), (1.5, 0.075), (1.425, 0), (0, 0)]]
# Handle and spout: for each of seven steps, two points of the outline and the half width at both.
HANDLE = [
    ((-1.6, 2.025), (-1.5, 2.25), 0.3, 0.3), ((-2.3, 2.025), (-2.5, 2.25), 0.3, 0.3), ((-2.7, 2.025), (-3, 2.25), 0.3, 0.3),
    ((-2.7, 1.8), (-3, 1.8), 0.3, 0.3),
    ((-2.7, 1.575), (-3, 1.35), 0.3, 0.3), ((-2.5, 1.125), (-2.65, 0.9375), 0.3, 0.3), ((-2, 0.9), (-1.9, 0.6), 0.3, 0.3),
]
SPOUT = [
    ((1.7, 1.425), (1.7, 0.6), 0.66, 0.66), ((2.6, 1.425), (3.1, 0.825), 0.66, 0.66), ((2.3, 2.1), (2.4, 2.025), 0.25, 0.25),
    ((2.7, 2.4), (3.3, 2.4), 0.25, 0.25),
    ((2.8, 2.475), (3.525, 2.49375), 0.25, 0.25), ((2.9, 2.475), (3.45, 2.5125), 0.15, 0.15), ((2.8, 2.4), (3.2, 2.4), 0.15, 0.15),
]


def bernstein(t):
    s = 1 - t
    return (s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t)


def patch(points):
    """The surface of 4 x 4 control points (x, y, z with z up), as points with y up."""

    def at(u, v):
        p = [0.0, 0.0, 0.0]
        for b, row in zip(bernstein(v), points):
            for a, point in zip(bernstein(u), row):
                for i in range(3):
                    p[i] += a * b * point[i]
        return (p[0], p[2], -p[1])

    return at


def patches():
    """All 32, each with whether its normals are to be flipped to point outwards."""
    for profile in LID + RIM + BODY + BOTTOM:
        for quarter in range(4):
            c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[quarter]
            rows = []
            for r, z in profile:
                arc = [(r, 0), (r, ARC * r), (ARC * r, r), (0, r)]
                rows.append([(c * x - s * y, s * x + c * y, z) for x, y in arc])
            yield patch(rows), True
    for outline in (HANDLE, SPOUT):
        for first in (0, 3):
            for side in (1, -1):
                rows = []
                for (ax, az), (bx, bz), a_wide, b_wide in outline[first : first + 4]:
                    rows.append([(ax, 0, az), (ax, side * a_wide, az), (bx, side * b_wide, bz), (bx, 0, bz)])
                yield patch(rows), (side == 1) == (outline is SPOUT)


def teapot(mesh, material, fineness):
    for at, flip in patches():
        mesh.surface(material, at, fineness, fineness, flip=flip)


def obj(path, fineness=12):
    """The teapot alone, as an .obj with normals."""
    mesh = Mesh()
    teapot(mesh, "glossy", fineness)
    positions, normals, indices = mesh.parts["glossy"]
    with open(path, "w") as file:
        for p in positions:
            print("v", *(f"{c:.6g}" for c in p), file=file)
        for n in normals:
            print("vn", *(f"{c:.6g}" for c in n), file=file)
        for a, b, c in zip(indices[::3], indices[1::3], indices[2::3]):
            print(f"f {a+1}//{a+1} {b+1}//{b+1} {c+1}//{c+1}", file=file)
    return mesh.triangles()


def build():
    scene = Scene()
    scene.paint("glossy", 0.1, ks=0.7, exponent=20)
    mesh = Mesh()
    teapot(mesh, "glossy", 12)
    scene.add("teapot", mesh)
    scene.camera("front", (2.5, 5, 9), (0.2, 1.5, 0), 33)
    return scene


def pair():
    scene = Scene()
    scene.paint("Phong cos^5", 0, ks=1, exponent=5)
    scene.paint("Ward 0.2 / 0.5", 0, ks=1, ax=0.2, ay=0.5)
    for name, x in (("Phong cos^5", -3.6), ("Ward 0.2 / 0.5", 3.6)):
        mesh = Mesh()
        teapot(mesh, name, 12)
        scene.add(name, mesh, translation=(x, 0, 0))
    scene.camera("front", (0.2, 7, 15), (0.2, 1.4, 0), 20, aspect=2.6)
    return scene
