"""Keys of contents: of a file, and of a scene with the files that it names."""
import hashlib
import json
import os
import struct

_known = {}


def content_key(path):
    """32 hexadecimal digits of the bytes of a file, read once."""
    if path not in _known:
        with open(path, "rb") as file:
            _known[path] = hashlib.file_digest(file, "sha256").hexdigest()[:32]
    return _known[path]


def scene_key(path):
    """As content_key(), and of the files that the scene names: buffers, images, materials, lights."""
    if ("scene", path) not in _known:
        found = [path]
        for file in found:  # grows
            found += [other for other in _named_in(file) if other not in found]
        digests = "".join(sorted(content_key(file) for file in found))
        _known["scene", path] = hashlib.sha256(digests.encode()).hexdigest()[:32]
    return _known["scene", path]


def _named_in(path):
    folder, ending = os.path.dirname(path), os.path.splitext(path)[1].lower()
    names = []
    try:
        if ending == ".glb":
            with open(path, "rb") as file:
                length = struct.unpack("<5I", file.read(20))[3]
                names = list(_texts(json.loads(file.read(length))))
        elif ending in (".gltf", ".json"):
            with open(path, "rb") as file:
                names = list(_texts(json.load(file)))
        elif ending in (".obj", ".mtl"):
            if ending == ".obj":
                names = [os.path.basename(path)[:-4] + ".lights.json"]
            with open(path, encoding="utf-8", errors="replace") as file:
                for line in file:
                    words = line.split()
                    if len(words) > 1 and (words[0] == "mtllib" or ending == ".mtl" and words[0].lower().startswith(("map_", "bump", "disp", "norm"))):
                        names += [" ".join(words[1:]), *words[1:]]
    except (ValueError, struct.error):
        pass  # the programs say what is wrong with it
    files = []
    for name in names:
        if not name.startswith("data:") and len(name) < 4096 and "\0" not in name:
            full = os.path.realpath(os.path.join(folder, name.replace("%20", " ")))
            if os.path.isfile(full):
                files.append(full)
    return files


def _texts(tree):
    if isinstance(tree, str):
        yield tree
    elif isinstance(tree, dict):
        for value in tree.values():
            yield from _texts(value)
    elif isinstance(tree, list):
        for value in tree:
            yield from _texts(value)
