#!/usr/bin/env python3
"""Foretells time, memory and bytes moved of a run on many machines, by simulation from measured costs of the stages.
  cost.py measure SCENE FILE [--paths N] [--points CSV]
                                              measures the stages on one core of this machine, and writes their costs to FILE (JSON)
  cost.py predict FILE [--photons N,N,...] [--nodes N,N,...] [--sensors N] [--rays N] [--cores N] [--memory GB] [--node-MBps M] [--disk-MBps M]
                  [--start S] [--shards N]    prints a table (CSV): one row for each number of photons and of nodes
  cost.py compare FILE FOLDER                 prints what a finished run in FOLDER (pipelines/cluster.sh) took, stage by stage, beside the prediction
measure   needs about two minutes for the default --paths 2000000. Seconds are of the processor, so that other work on the machine does not count.
          --points: sensors (x,y,z,nx,ny,nz), up to 25,000 of which are measured; their cost depends on the place (default: a grid at half the
          height of the scene).
predict   shards of photons, their merge, the cache that the rays of sensors read, records of sensors in parts, their merge, and the reading of the
          sensors in parts. Shards and parts: one for each node, or --shards. --photons: paths. --start: seconds that the queue takes to start a job (2).
          --node-MBps (1000) and --disk-MBps (5000): how fast one node, and all nodes together, move bytes to and from the shared disk. --cores (1): of a
          node; photons and sensors use all of them, merges one. --memory (64): of a node; a merge that needs more sorts on disk. The column "breaks" names
          the stage that needs more memory than a node has, or says that no map can hold the photons.
"""
import csv
import json
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from costs.compare import compare
from costs.measure import measure
from costs.model import Site, simulate
from problem import Problem, main, nearest

STAGES = ("photons", "merge_photons", "source", "sensors", "merge_sensors", "read")


def load(path):
    try:
        with open(path, encoding="utf-8") as file:
            costs = json.load(file)
        for stage in (*STAGES, "tree", "merge_on_disk"):
            costs[stage]["seconds"]["each"] + costs[stage]["memory"]["each"]
        costs["stored_per_path"] + costs["source"]["bytes"]["fixed"]
        return costs
    except OSError as error:
        raise Problem(f"{path}: {error.strerror}", 3) from None
    except (ValueError, KeyError, TypeError):
        raise Problem(f"{path}: holds no costs; make it with  cost.py measure SCENE {path}", 3) from None


def print_predictions(path, photons=(1e6, 1e7, 1e8, 1e9, 1e10), nodes=(1, 10, 100, 1000), sensors=100000, rays=1024, cores=1, memory=64, node_MBps=1000,
                      disk_MBps=5000, start=2, shards=0):
    costs = load(path)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(("photons", "nodes", "seconds", "speedup", "merge_share", *(stage + "_s" for stage in STAGES), "peak_GB", "peak_stage", "moved_GB", "breaks"))
    for count in photons:
        site = lambda number: Site(int(number), cores, memory, start, node_MBps, disk_MBps)
        alone = simulate(costs, count, sensors, rays, 1, site(1)).total()
        for number in nodes:
            run = simulate(costs, count, sensors, rays, int(shards or number), site(number))
            worst = max(run.memory, key=run.memory.get)
            table.writerow((f"{count:.0f}", int(number), f"{run.total():.1f}", f"{alone / run.total():.2f}", f"{run.merge_share():.3f}",
                            *(f"{run.seconds.get(stage, 0):.1f}" for stage in STAGES),
                            f"{run.memory[worst] / 1e9:.2f}", worst, f"{run.moved / 1e9:.2f}", run.breaks))


def print_comparison(path, folder):
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(("stage", "jobs", "measured_s", "predicted_s", "ratio", "measured_MB", "predicted_MB"))
    for stage, jobs, measured, predicted, memory, predicted_memory in compare(load(path), folder):
        table.writerow((stage, jobs, f"{measured:.2f}", f"{predicted:.2f}", f"{predicted / measured:.2f}" if measured else "",
                        f"{memory / 1e6:.0f}", f"{predicted_memory / 1e6:.0f}"))


def options(words, known):
    """--name VALUE words as keywords."""
    found = {}
    for i in range(0, len(words), 2):
        name = words[i][2:].replace("-", "_") if words[i].startswith("--") else ""
        if name not in known:
            raise Problem(f"{words[i]}: no such option{nearest(name.replace('_', '-'), [k.replace('_', '-') for k in known])}")
        if i + 1 == len(words):
            raise Problem(f"{words[i]}: give a value")
        try:
            numbers = [float(text) for text in words[i + 1].split(",")]
        except ValueError:
            numbers = []
        lists = name in ("photons", "nodes")
        least = 1 if lists or name in ("cores", "paths", "node_MBps", "disk_MBps") else 0
        if not numbers or not all(math.isfinite(n) and n >= least for n in numbers) or len(numbers) > 1 and not lists:
            raise Problem(f"{words[i]} {words[i + 1]}: give {f'numbers of at least {least}, comma by comma' if lists else f'a number of at least {least}'}")
        found[name] = numbers if lists else numbers[0]
    return found


def start():
    words = sys.argv[1:]
    if not words or words[0] in ("-h", "--help"):
        print(__doc__.strip(), file=sys.stdout if words else sys.stderr)
        return 0 if words else 2
    if words[0] == "measure" and len(words) >= 3:
        points = words[words.index("--points") + 1] if "--points" in words[3:-1] else None
        others = [word for i, word in enumerate(words) if points is None or words[i - 1] != "--points" and word != "--points"]
        paths = int(options(others[3:], ["paths", "points"]).get("paths", 2000000))
        if not os.path.isfile(words[1]):
            raise Problem(f"{words[1]}: no such file", 3)
        measure(words[1], words[2], paths, points)
        print(f"costs: {words[2]}")
    elif words[0] == "predict" and len(words) >= 2:
        print_predictions(words[1], **options(words[2:], ["photons", "nodes", "sensors", "rays", "cores", "memory", "node_MBps", "disk_MBps", "start", "shards"]))
    elif words[0] == "compare" and len(words) == 3:
        print_comparison(words[1], words[2])
    else:
        raise Problem(f'"{words[0]}": give measure SCENE FILE, predict FILE or compare FILE FOLDER; see cost.py --help')
    return 0


if __name__ == "__main__":
    main("cost.py", start)
