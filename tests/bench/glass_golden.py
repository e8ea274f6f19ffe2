#!/usr/bin/env python3
"""All points, rings and cells of the golden values for glass and mirrors, by every estimator that can read them.
  glass_golden.py SHARED FOLDER [--programs FOLDER] [--estimators exact,path,hull,gathered,cached] [--only TEXT] [--photons N]
SHARED holds golden/glass and scenes/glass. The values are closed forms and quadratures of another program, with polarisation.
FOLDER/results.csv gets a row for each value, as soon as it is there, and a second run goes on where the first ended:
  table,case,place,estimator,value_lx,stderr_lx,truth_lx,judged
A value is judged right within 2 % or two standard errors. A ring or cell is the mean over 48 points, and its error that of the points."""
import argparse
import csv
import itertools
import math
import os
import shlex
import subprocess
import sys

RING_POINTS = 48
CELL_SIDE = 7


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def ring_points(row):
    """Points of equal area between two circles, facing up."""
    r0, r1 = float(row["r0"]), float(row["r1"])
    for i in range(RING_POINTS):
        r = math.sqrt(r0 * r0 + (r1 * r1 - r0 * r0) * (i + 0.5) / RING_POINTS)
        yield r * math.cos(2.399963 * i), float(row["plane_y"]), r * math.sin(2.399963 * i), 0, 1, 0


def cell_points(row):
    x0, x1, z0, z1 = (float(row[name]) for name in ("x0", "x1", "z0", "z1"))
    for i, j in itertools.product(range(CELL_SIDE), repeat=2):
        yield x0 + (x1 - x0) * (i + 0.5) / CELL_SIDE, 0, z0 + (z1 - z0) * (j + 0.5) / CELL_SIDE, 0, 1, 0


def tasks(golden):
    """(table, scene, options, case) -> list of (place, truth, points)"""
    found = {}
    for row in read(f"{golden}/g3_points.csv"):
        point = tuple(row[name] for name in ("x", "y", "z", "nx", "ny", "nz"))
        found.setdefault(("points", row["scene"], row["options"], row["case"]), []).append((" ".join(point[:3]), float(row["E_lx"]), [point]))
    for row in read(f"{golden}/g4_rings.csv"):
        place = f"y {row['plane_y']} r {row['r0']} to {row['r1']}"
        found.setdefault(("rings", row["scene"], row["options"], row["case"]), []).append((place, float(row["E_mean_lx"]), list(ring_points(row))))
    for row in read(f"{golden}/g4_cells.csv"):
        place = f"x {row['x0']} to {row['x1']} z {row['z0']} to {row['z1']}"
        found.setdefault(("cells", row["scene"], row["options"], row["case"]), []).append((place, float(row["E_mean_lx"]), list(cell_points(row))))
    return found


def run(programs, *command):
    done = subprocess.run([f"{programs}/{command[0]}", *map(str, command[1:])], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}: exit {done.returncode}: {done.stderr.strip().splitlines()[-1:]}")


def estimate(name, programs, scene, options, points, photons, folder):
    """Writes sensors.csv of the points by one estimator."""
    out = ["--points", points, "-o", f"{folder}/sensors.csv", "--quiet"]
    if name in ("exact", "path"):
        run(programs, "phos-sense", scene, *options, "--exact", "--samples", 4000000, "--error", 0.005, "--method", "path" if name == "path" else "auto", *out)
        return
    run(programs, "phos-photons", scene, *options, "--photons", photons, "--quiet", "-o", f"{folder}/light.photons")
    more = {"hull": [], "gathered": ["--estimate", "gather", "--rays", 512],
            "cached": ["--estimate", "gather", "--rays", 512, "--direct", "cached", "--accuracy", 0.05]}[name]
    at = [] if name == "hull" else ["--at", points, "--place", "every"]
    files = options if "--luminaire" in options else []
    run(programs, "phos-irradiance", scene, f"{folder}/light.photons", *files, *at, *more, "--quiet", "-o", f"{folder}/light.irradiance")
    run(programs, "phos-sense", scene, f"{folder}/light.irradiance", *files, *(["--light-samples", 0] if name == "cached" else []), *out)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("shared")
    parser.add_argument("folder")
    parser.add_argument("--programs", default=os.path.join(os.path.dirname(__file__), "../../build/release/bin"))
    parser.add_argument("--estimators", default="exact,hull,gathered,cached")
    parser.add_argument("--only", default="")
    parser.add_argument("--photons", type=int, default=1000000)
    given = parser.parse_args()
    golden, scenes = f"{given.shared}/golden/glass", f"{given.shared}/scenes/glass"
    if not os.path.isdir(golden):
        sys.exit("skipped: no golden/glass in " + given.shared)
    os.makedirs(given.folder, exist_ok=True)
    results = f"{given.folder}/results.csv"
    columns = ["table", "case", "place", "estimator", "value_lx", "stderr_lx", "truth_lx", "judged"]
    if not os.path.exists(results):
        with open(results, "w", newline="") as file:
            csv.writer(file).writerow(columns)
    done = {(row["table"], row["case"], row["estimator"]) for row in read(results)}
    for (table, scene, options, case), places in tasks(golden).items():
        words = shlex.split(options)
        words = [word.replace("=", f"={scenes}/", 1) if words[i - 1] == "--luminaire" else word for i, word in enumerate(words)]
        with open(f"{given.folder}/points.csv", "w") as file:
            file.write("x,y,z,nx,ny,nz\n")
            file.writelines(",".join(map(str, point)) + "\n" for _, _, points in places for point in points)
        for name in given.estimators.split(","):
            if (table, case, name) in done or given.only not in case:
                continue
            try:
                estimate(name, given.programs, f"{scenes}/{scene}", words, f"{given.folder}/points.csv", given.photons, given.folder)
                read_values = [(float(row["E_lx"]), float(row["stderr_lx"])) for row in read(f"{given.folder}/sensors.csv")]
            except RuntimeError as error:
                print(f"{case}: {name}: {error}", file=sys.stderr)
                continue
            values = iter(read_values)
            with open(results, "a", newline="") as file:
                for place, truth, points in places:
                    part = list(itertools.islice(values, len(points)))
                    value = sum(v for v, _ in part) / len(part)
                    stderr = math.sqrt(sum(e * e for _, e in part)) / len(part)
                    judged = "right" if abs(value - truth) <= max(0.02 * abs(truth), 2 * stderr, 1e-9) else "wrong"
                    csv.writer(file).writerow([table, case, place, name, f"{value:.6g}", f"{stderr:.3g}", f"{truth:.6g}", judged])
    count = {}
    for row in read(results):
        total = count.setdefault((row["table"], row["estimator"]), [0, 0])
        total[0] += row["judged"] == "right"
        total[1] += 1
    for (table, name), (right, total) in sorted(count.items()):
        print(f"{table} by {name}: {right} of {total} within 2 % or two standard errors")


main()
