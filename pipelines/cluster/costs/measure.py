"""Measures what the stages cost on one core of this machine."""
import csv
import json
import math
import os
import subprocess
import tempfile

from problem import Problem

RAYS = 256  # of a sensor, while measuring
MOST_SENSORS = 25000  # that are measured
COLUMNS = ("x", "y", "z", "nx", "ny", "nz")


def measure(scene, out, paths, points=None):
    """Writes the costs (JSON): per stage, seconds of the processor, bytes of memory and bytes of the file, each at 0 items and for each further item;
    where each item meets all others, as records of sensors that lie close together do, also for each pair of an item and another."""
    sensors = _rows(points) if points else None
    with tempfile.TemporaryDirectory(dir=os.path.dirname(os.path.abspath(out))) as folder:
        photons, maps = _photons(scene, folder, (paths // 4, paths))
        costs = {"scene": os.path.basename(scene), **photons, **_sources(scene, folder, maps), **_sensors(scene, folder, sensors)}
    with open(out, "w", encoding="utf-8") as file:
        json.dump(costs, file, indent=1)
        file.write("\n")


def n_log_n(n):
    """A merge sorts its photons into a tree."""
    return n * math.log2(max(n, 2))


def line(few, many, at_few, at_many):
    """Cost at 0 and for each item, neither below 0, through two measured points."""
    each = max((many - few) / (at_many - at_few), 0)
    return {"fixed": max(few - each * at_few, 0), "each": each}


def curve(counts, costs):
    """Cost at 0, for each item, and for each pair of items, none below 0, through three measured points: the more sensors
    a grid of one area has, the more others each meets."""
    (a, b, c), (at_a, at_b, at_c) = counts, costs
    pair = max(((at_c - at_b) / (c - b) - (at_b - at_a) / (b - a)) / (c - a), 0)
    return {**line(at_a - pair * a * a, at_c - pair * c * c, a, c), "pair": pair}


def spent(*words):
    """Seconds of the processor and peak of memory (bytes) of a program on one thread."""
    with tempfile.TemporaryFile() as said:
        try:
            child = subprocess.Popen([*words, "--threads", "1", "--quiet"], stdout=subprocess.DEVNULL, stderr=said)
        except OSError as error:
            raise Problem(f"{words[0]}: {error.strerror}; put the folder of the programs on PATH", 3) from None
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            said.seek(0)
            last = said.read().decode(errors="replace").strip().splitlines()[-1:] or ["it said nothing"]
            raise Problem(f"{words[0]} ended with code {child.returncode}: {last[0]}", 3)
    return used.ru_utime + used.ru_stime, used.ru_maxrss * 1024


def _photons(scene, folder, counts):
    """Costs of tracing, of merges in memory and on disk, and of a run alone; and the maps: number of paths -> file."""
    traced, merged, on_disk, alone, maps = [], [], [], [], {}
    for count in counts:
        maps[count], stats = os.path.join(folder, f"{count}.photons"), os.path.join(folder, "stats.json")
        shards = [os.path.join(folder, f"{count}-{k}.photons") for k in (1, 2)]
        whole = ["phos-photons", scene, "--photons", str(count), "--caustic-photons", "0"]
        half = [spent(*whole, "--shard", f"{k}/2", "-o", shard) for k, shard in enumerate(shards, 1)]
        traced.append((*half[0], sum(map(os.path.getsize, shards)) / 2))
        on_disk.append(spent("phos-merge", *shards, "--memory", "64M", "--stats", stats, "-o", maps[count]))
        with open(stats, encoding="utf-8") as file:
            told = json.load(file)
        if not told["on_disk"]:
            raise Problem(f"--paths {max(counts)}: too few: {told['stored']} photons of a quarter fit in 64 MiB, and a merge on disk is to be measured; "
                          "give more")
        merged.append((*spent("phos-merge", *shards, "-o", maps[count]), os.path.getsize(maps[count])))
        alone.append(spent(*whole, "-o", maps[count]))
    few, many = counts
    grown = n_log_n(few), n_log_n(many)
    costs = {"stored_per_path": told["stored"] / many}
    costs["photons"] = {name: line(traced[0][i], traced[1][i], few / 2, many / 2) for i, name in enumerate(("seconds", "memory", "bytes"))}
    costs["merge_photons"] = {"seconds": line(merged[0][0], merged[1][0], *grown), "memory": line(merged[0][1], merged[1][1], few, many),
                              "bytes": line(merged[0][2], merged[1][2], few, many)}
    costs["merge_on_disk"] = {"seconds": line(on_disk[0][0], on_disk[1][0], *grown), "memory": {"fixed": 64 * 2**20, "each": 0}}
    # One run alone traces its paths and makes the tree.
    trace = costs["photons"]["seconds"]
    of_tree = [max(run[0] - trace["fixed"] - trace["each"] * count, 0) for run, count in zip(alone, counts)]
    costs["tree"] = {"seconds": line(*of_tree, *grown), "memory": line(alone[0][1], alone[1][1], few, many)}
    return costs, maps


def _sources(scene, folder, maps):
    """Costs of the cache that the rays of sensors read, by the number of paths of its map."""
    few, many = sorted(maps)
    source = os.path.join(folder, "source.irradiance")
    runs = [spent("phos-irradiance", scene, maps[count], "--place", "surface", "--accuracy", "0.3", "-o", source) for count in (few, many)]
    return {"source": {"seconds": line(runs[0][0], runs[1][0], few, many), "memory": line(runs[0][1], runs[1][1], few, many),
                       "bytes": {"fixed": os.path.getsize(source), "each": 0}}}


def _sensors(scene, folder, given):
    """Costs of the records of sensors in parts, of their merge, and of their reading: of ever more of the sensors `given` (lines), or of a grid."""
    most = min(len(given), MOST_SENSORS) if given else MOST_SENSORS
    counts = (max(most // 100, 4), most // 4, most)
    source = os.path.join(folder, "source.irradiance")
    low, high = _bounds(scene)
    made, merged, read = [], [], []
    for count in counts:
        points, records = os.path.join(folder, "points.csv"), os.path.join(folder, "records.irradiance")
        if given:
            _write_rows(points, [given[k * len(given) // count] for k in range(count)])
        else:
            _write_rows(points, _grid(math.isqrt(count), low, high))
        parts = [os.path.join(folder, f"part-{k}.irradiance") for k in (1, 2)]
        ask = ["phos-irradiance", scene, source, "--place", "every", "--at", points, "--estimate", "gather", "--rays", str(RAYS)]
        half = [spent(*ask, "--part", f"{k}/2", "-o", part) for k, part in enumerate(parts, 1)]
        made.append(tuple((a + b) / 2 for a, b in zip(*half)) + (sum(map(os.path.getsize, parts)) / 2,))
        merged.append((*spent("phos-merge", *parts, "-o", records), os.path.getsize(records)))
        read.append(spent("phos-sense", scene, records, "--points", points, "-o", os.path.join(folder, "read.csv")))
    few, many = counts[0], counts[-1]
    fit = lambda runs, i, scale: line(runs[0][i], runs[-1][i], few * scale, many * scale)
    return {"sensors": {"seconds": fit(made, 0, RAYS / 2), "memory": fit(made, 1, 0.5), "bytes": fit(made, 2, 0.5)},
            "merge_sensors": {"seconds": line(merged[1][0], merged[2][0], counts[1], counts[2]), "memory": fit(merged, 1, 1), "bytes": fit(merged, 2, 1)},
            "read": {"seconds": curve(counts, [run[0] for run in read]), "memory": fit(read, 1, 1)}}


def _bounds(scene):
    told = subprocess.run(["phos-scene", scene, "--json"], capture_output=True, text=True, check=False)
    if told.returncode not in (0, 1):
        raise Problem(f"phos-scene ended with code {told.returncode}: {told.stderr.strip()}", 3)
    return json.loads(told.stdout)["bounds_m"]


def _grid(side, low, high):
    """Sensors of a grid at half the height of the scene."""
    for i in range(side * side):
        u, v = (0.1 + 0.8 * (k + 0.5) / side for k in divmod(i, side))
        yield f"{low[0] + u * (high[0] - low[0])},{0.5 * (low[1] + high[1])},{low[2] + v * (high[2] - low[2])},0,1,0"


def _rows(path):
    """The sensors of a CSV, as lines of six numbers."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            table = list(csv.DictReader(file))
    except OSError as error:
        raise Problem(f"{path}: {error.strerror}", 3) from None
    try:
        rows = [",".join(row[name] for name in COLUMNS) for row in table]
    except (KeyError, TypeError):
        raise Problem(f"{path}: needs the columns {','.join(COLUMNS)}", 3) from None
    if len(rows) < 16:
        raise Problem(f"{path}: {len(rows)} sensors are too few to measure; give 16 or more", 3)
    return rows


def _write_rows(path, rows):
    with open(path, "w", encoding="utf-8") as file:
        file.write(",".join(COLUMNS) + "\n")
        file.writelines(row + "\n" for row in rows)
