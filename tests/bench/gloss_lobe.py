"""Gives a material of a .glb another glossy lobe: gloss_lobe.py SCENE MATERIAL phong:EXPONENT|ggx:ALPHA OUTPUT"""

import json
import struct
import sys

scene, name, lobe, output = sys.argv[1:]
with open(scene, "rb") as file:
    data = file.read()
length = struct.unpack("<I", data[12:16])[0]
document = json.loads(data[20 : 20 + length])
try:
    kind, value = lobe.split(":")
    model = {
        "phong": {"brdf": "phong", "kd": [0.05] * 3, "ks": [0.65] * 3, "exponent": float(value)},
        "ggx": {"brdf": "conductor", "f0": [0.65] * 3, "alpha": float(value)},
    }[kind]
except (KeyError, ValueError):
    sys.exit(f"{lobe}: no lobe; give phong:EXPONENT or ggx:ALPHA")
chosen = [m for m in document["materials"] if m.get("name") == name]
if not chosen:
    sys.exit(f"{scene}: no material {name}")
for material in chosen:
    material["extras"] = {"phos": model}
text = json.dumps(document).encode()
text += b" " * (-len(text) % 4)
chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + data[20 + length :]
with open(output, "wb") as file:
    file.write(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)
