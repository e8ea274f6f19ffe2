"""Makes scenes that stand in for those of the papers: make.py NAME OUTPUT.glb

hall    an open court with two storeys of arcades (the role of Sponza): two lamps
nave    a church-like nave with aisles, vaults and an apse (the role of Sibenik): two lamps
kite    a kite that flies in a room (the flying kite): 300 frames
room    furniture, some of it glossy; a lamp that swings and a ball that rolls (the Japanese interior): 300 frames
villa   rooms with 11 luminaires of 760 shining triangles and windows (the villa Arpel); give --sky overcast too
teapot  Newell's teapot of 1975; OUTPUT.obj gives its triangles alone
teapots two of them side by side, of a Phong lobe cos^5 and of Ward's anisotropic lobe 0.2 / 0.5

Prints the number of triangles.
"""

import importlib
import sys

NAMES = ("hall", "nave", "kite", "room", "villa", "teapot", "teapots")


def main(words):
    if len(words) != 2:
        sys.stderr.write(__doc__)
        return 2
    name, output = words
    if name not in NAMES:
        sys.stderr.write(f"make.py: {name}: no such scene; give one of {', '.join(NAMES)}\n")
        return 2
    try:
        module = importlib.import_module("teapot" if name == "teapots" else name)
        if name == "teapot" and output.endswith(".obj"):
            print(module.obj(output))
            return 0
        scene = module.pair() if name == "teapots" else module.build()
        scene.write(output)
        print(scene.triangles)
    except OSError as error:
        sys.stderr.write(f"make.py: {output}: {error.strerror}\n")
        return 3
    return 0


sys.exit(main(sys.argv[1:]))
