"""Writes glTF scenes (.glb): materials, meshes of simple shapes, nodes that may move, cameras. Lengths in m, light in cd/m2, Y up."""

import json
import math
import struct


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(v):
    size = math.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)
    return (v[0] / size, v[1] / size, v[2] / size) if size > 0 else (0.0, 1.0, 0.0)


def turn(axis, degrees):
    """The quaternion of a turn about an axis."""
    half = math.radians(degrees) / 2
    x, y, z = unit(axis)
    return (x * math.sin(half), y * math.sin(half), z * math.sin(half), math.cos(half))


def turned(quaternion, v):
    x, y, z, w = quaternion
    t = tuple(2 * c for c in cross((x, y, z), v))
    u = cross((x, y, z), t)
    return tuple(v[i] + w * t[i] + u[i] for i in range(3))


class Mesh:
    """Triangles, by material. Fronts are counter-clockwise: their normals point to the side that is seen."""

    def __init__(self):
        self.parts = {}

    def triangles(self):
        return sum(len(indices) // 3 for _, _, indices in self.parts.values())

    def surface(self, material, point, across, up, flip=False):
        """A smooth surface point(u, v), u and v from 0 to 1, of `across` x `up` cells; normals by differences along both."""
        positions, normals, indices = self.parts.setdefault(material, ([], [], []))
        first = len(positions)
        h = 1e-4
        for j in range(up + 1):
            for i in range(across + 1):
                u, v = i / across, j / up
                # Normals of poles and ends are those of the surface just beside them.
                a, b = min(max(u, h), 1 - h), min(max(v, h), 1 - h)
                normal = unit(cross(sub(point(a + h, b), point(a - h, b)), sub(point(a, b + h), point(a, b - h))))
                positions.append(point(u, v))
                normals.append(tuple(-c for c in normal) if flip else normal)
        for j in range(up):
            for i in range(across):
                a = first + j * (across + 1) + i
                b, c, d = a + 1, a + across + 2, a + across + 1
                for t in ((a, b, c), (a, c, d)):
                    p, q, r = (positions[k] for k in t)
                    n = cross(sub(q, p), sub(r, p))
                    if n[0] ** 2 + n[1] ** 2 + n[2] ** 2 > 1e-20:
                        indices.extend(reversed(t) if flip else t)

    def polygon(self, material, *corners):
        """A flat convex polygon, its corners counter-clockwise as seen from its front."""
        positions, normals, indices = self.parts.setdefault(material, ([], [], []))
        first = len(positions)
        normal = unit(cross(sub(corners[1], corners[0]), sub(corners[2], corners[0])))
        positions.extend(corners)
        normals.extend([normal] * len(corners))
        for i in range(1, len(corners) - 1):
            indices.extend((first, first + i, first + i + 1))

    def box(self, material, lo, hi, inward=False, without=""):
        """A box; `without` names sides that are left out: x X y Y z Z, capitals for the upper ones."""
        (x, y, z), (u, v, w) = lo, hi
        sides = {
            "x": ((x, y, z), (x, y, w), (x, v, w), (x, v, z)),
            "X": ((u, y, z), (u, v, z), (u, v, w), (u, y, w)),
            "y": ((x, y, z), (u, y, z), (u, y, w), (x, y, w)),
            "Y": ((x, v, z), (x, v, w), (u, v, w), (u, v, z)),
            "z": ((x, y, z), (x, v, z), (u, v, z), (u, y, z)),
            "Z": ((x, y, w), (u, y, w), (u, v, w), (x, v, w)),
        }
        for name, corners in sides.items():
            if name not in without:
                self.polygon(material, *(reversed(corners) if inward else corners))

    def revolve(self, material, profile, centre=(0, 0, 0), sides=24, steps=1):
        """A profile of (radius, height), from below to above on the outside, turned about a vertical axis. Its corners stay sharp;
        of a function of 0 to 1 in place of points, `steps` are taken and all is smooth."""
        cx, cy, cz = centre

        def ring(at):
            def point(u, v):
                r, y = at(v)
                return (cx + r * math.sin(2 * math.pi * u), cy + y, cz + r * math.cos(2 * math.pi * u))

            return point

        if callable(profile):
            self.surface(material, ring(profile), sides, steps)
            return
        for (r, y), (s, z) in zip(profile, profile[1:]):
            self.surface(material, ring(lambda v, r=r, y=y, s=s, z=z: (r + v * (s - r), y + v * (z - y))), sides, 1)

    def tube(self, material, path, radius, sides=8, steps=16):
        """A tube about path(v), v from 0 to 1, open at its ends."""

        def point(u, v):
            h = 1e-3
            along = unit(sub(path(min(v + h, 1)), path(max(v - h, 0))))
            side = unit(cross((0.0, 1.0, 0.0) if abs(along[1]) < 0.9 else (1.0, 0.0, 0.0), along))
            other = cross(along, side)
            at, r, a = path(v), radius(v) if callable(radius) else radius, 2 * math.pi * u
            return tuple(at[i] + r * (math.cos(a) * side[i] + math.sin(a) * other[i]) for i in range(3))

        self.surface(material, point, sides, steps)

    def wall(self, material, origin, along, up, width, height, thickness, openings=(), steps=12):
        """An upright wall of that thickness, its face at `origin` towards along x up. An opening (left, right, sill, spring, rise) is
        of a rectangle up to `spring` and an arch of that rise above; rise 0 is a lintel. The openings stand from left to right."""
        deep = cross(along, up)

        def at(x, y, d):
            return tuple(origin[i] + x * along[i] + y * up[i] - d * deep[i] for i in range(3))

        def slab(x0, x1, y0, y1, z0, z1):
            """Front and back between the heights y0, y1 at x0 and z0, z1 at x1."""
            self.polygon(material, at(x0, y0, 0), at(x1, z0, 0), at(x1, z1, 0), at(x0, y1, 0))
            self.polygon(material, at(x1, z0, thickness), at(x0, y0, thickness), at(x0, y1, thickness), at(x1, z1, thickness))

        left = 0.0
        for x0, x1, sill, spring, rise in openings:
            if x0 > left:
                slab(left, x0, 0, height, 0, height)
            if sill > 0:
                slab(x0, x1, 0, sill, 0, sill)
                self.polygon(material, at(x0, sill, 0), at(x1, sill, 0), at(x1, sill, thickness), at(x0, sill, thickness))
            if spring > sill:
                self.polygon(material, at(x0, sill, thickness), at(x0, spring, thickness), at(x0, spring, 0), at(x0, sill, 0))
                self.polygon(material, at(x1, sill, 0), at(x1, spring, 0), at(x1, spring, thickness), at(x1, sill, thickness))
            pieces = steps if rise > 0 else 1
            # Equal angles, as an arch is steepest at its ends.
            cut = [0.5 - 0.5 * math.cos(math.pi * i / pieces) for i in range(pieces + 1)]
            rim = [(x0 + c * (x1 - x0), spring + rise * math.sqrt(max(0.0, 1 - (2 * c - 1) ** 2))) for c in cut]
            for (a, p), (b, q) in zip(rim, rim[1:]):
                slab(a, b, p, height, q, height)
                self.polygon(material, at(a, p, 0), at(a, p, thickness), at(b, q, thickness), at(b, q, 0))
            left = x1
        if left < width:
            slab(left, width, 0, height, 0, height)


class Scene:
    def __init__(self, frames=0, fps=25):
        self.frames, self.fps = frames, fps
        self.materials, self.meshes, self.nodes, self.cameras, self.channels = [], [], [], [], []
        self.names, self.views, self.accessors, self.data = {}, [], [], bytearray()
        self.triangles = 0

    def paint(self, name, kd, ks=None, exponent=20, shine=None, **ward):
        """A material: Lambert, or with `ks` Phong, or Ward with ax and ay; `shine` is the luminance of one that emits, cd/m2 RGB."""
        kd = list(kd) if isinstance(kd, (list, tuple)) else [kd] * 3
        model = {"brdf": "lambert", "kd": kd}
        if ks is not None:
            ks = list(ks) if isinstance(ks, (list, tuple)) else [ks] * 3
            model = {"brdf": "ward", "kd": kd, "ks": ks, **ward} if ward else {"brdf": "phong", "kd": kd, "ks": ks, "exponent": exponent}
        material = {
            "name": name,
            "pbrMetallicRoughness": {"baseColorFactor": kd + [1], "metallicFactor": 0, "roughnessFactor": 0.5 if ks else 1},
            "extras": {"phos": model},
        }
        if shine:
            most = max(shine)
            material["emissiveFactor"] = [c / most for c in shine]
            material["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": most}}
        self.names[name] = len(self.materials)
        self.materials.append(material)

    def accessor(self, rows, kind):
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[kind]
        flat = [c for row in rows for c in row] if width > 1 else list(rows)
        whole = kind == "SCALAR" and all(isinstance(c, int) for c in flat)
        start = len(self.data)
        self.data += struct.pack(f"<{len(flat)}{'I' if whole else 'f'}", *flat)
        self.views.append({"buffer": 0, "byteOffset": start, "byteLength": len(self.data) - start})
        entry = {"bufferView": len(self.views) - 1, "componentType": 5125 if whole else 5126, "count": len(rows), "type": kind}
        if width == 3 or (kind == "SCALAR" and not whole):
            read = struct.unpack_from(f"<{len(flat)}f", self.data, start)
            entry["min"] = [min(read[i::width]) for i in range(width)]
            entry["max"] = [max(read[i::width]) for i in range(width)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def add(self, name, mesh, translation=None, rotation=None):
        """A node that shows a mesh; returns its number."""
        primitives = []
        for material, (positions, normals, indices) in mesh.parts.items():
            primitives.append({
                "attributes": {"POSITION": self.accessor(positions, "VEC3"), "NORMAL": self.accessor(normals, "VEC3")},
                "indices": self.accessor(indices, "SCALAR"),
                "material": self.names[material],
            })
        self.meshes.append({"name": name, "primitives": primitives})
        self.triangles += mesh.triangles()
        node = {"name": name, "mesh": len(self.meshes) - 1}
        if translation:
            node["translation"] = list(translation)
        if rotation:
            node["rotation"] = list(rotation)
        self.nodes.append(node)
        return len(self.nodes) - 1

    def move(self, node, path, at):
        """Animates "translation" or "rotation" of a node: at(frame), at each frame."""
        rows = [tuple(at(frame)) for frame in range(self.frames)]
        times = self.accessor([frame / self.fps for frame in range(self.frames)], "SCALAR")
        self.channels.append((node, path, times, self.accessor(rows, "VEC3" if path == "translation" else "VEC4")))

    def camera(self, name, eye, target, yfov=55, aspect=4 / 3):
        z = unit(sub(eye, target))
        x = unit(cross((0, 1, 0), z))
        y = cross(z, x)
        self.cameras.append({"name": name, "type": "perspective", "perspective": {
            "yfov": math.radians(yfov), "aspectRatio": aspect, "znear": 0.01}})
        matrix = [*x, 0, *y, 0, *z, 0, *eye, 1]
        self.nodes.append({"name": name, "camera": len(self.cameras) - 1, "matrix": matrix})

    def write(self, path):
        document = {
            "asset": {"version": "2.0", "generator": "phos, pipelines/scenes"},
            "extensionsUsed": ["KHR_materials_emissive_strength"],
            "scene": 0,
            "scenes": [{"nodes": list(range(len(self.nodes)))}],
            "nodes": self.nodes, "meshes": self.meshes, "materials": self.materials, "cameras": self.cameras,
            "buffers": [{"byteLength": len(self.data)}], "bufferViews": self.views, "accessors": self.accessors,
        }
        if self.channels:
            document["scenes"][0]["extras"] = {"animation": {"frames": self.frames, "fps": self.fps}}
            document["animations"] = [{
                "channels": [{"sampler": i, "target": {"node": n, "path": p}} for i, (n, p, _, _) in enumerate(self.channels)],
                "samplers": [{"input": t, "output": o} for _, _, t, o in self.channels],
            }]
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(self.data), b"BIN\0") + bytes(self.data)
        with open(path, "wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
