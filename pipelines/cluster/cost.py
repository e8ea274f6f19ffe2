#!/usr/bin/env python3
"""Foretells time, memory and bytes moved of a run on many machines, by simulation from measured costs of the stages.
  cost.py measure SCENE FILE [--paths N]      measures the stages on one core of this machine, and writes their costs to FILE (JSON)
  cost.py predict FILE [--photons N,N,...] [--nodes N,N,...] [--sensors N] [--rays N] [--cores N] [--memory GB] [--node-MBps M] [--disk-MBps M]
                  [--start S] [--shards N]    prints a table (CSV): one row for each number of photons and of nodes
  cost.py compare FILE FOLDER                 prints what a finished run in FOLDER (pipelines/cluster.sh) took, stage by stage, beside the prediction
measure   needs about a minute for the default --paths 2000000. Seconds are of the processor, so that other work on the machine does not count.
predict   shards of photons, their merge, records of sensors in parts, their merge, and the reading of the sensors in parts. Reading costs more where many
          records overlap; it is measured for records that do not. Shards and parts: one for each node, or
          --shards. --start: seconds that the queue takes to start a job (2). --node-MBps (1000) and --disk-MBps (5000): how fast one node, and all
          nodes together, move bytes to and from the shared disk. --cores (1): of a node; photons and sensors use all of them, merges one. --memory (64): of
          a node; the column "fits" names the stage that needs more.
"""
import csv
import heapq
import json
import math
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from problem import Problem, main, nearest


# --- measure

def spent(*words):
    """CPU seconds and peak memory (bytes) of a program."""
    with tempfile.TemporaryFile() as said:
        try:
            child = subprocess.Popen([*words, "--threads", "1", "--quiet"], stdout=subprocess.DEVNULL, stderr=said)
        except OSError as error:
            raise Problem(f"{words[0]}: {error.strerror}; put the folder of the programs on PATH", 3) from None
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode != 0:
            said.seek(0)
            raise Problem(f"{words[0]} ended with code {child.returncode}: {said.read().decode(errors='replace').strip().splitlines()[-1:]}", 3)
    return used.ru_utime + used.ru_stime, used.ru_maxrss * 1024


def line(small, large, at_small, at_large):
    """Cost at 0 and for each item, neither below 0, through two measured points."""
    each = max((large - small) / (at_large - at_small), 0)
    return {"fixed": max(small - each * at_small, 0), "each": each}


def measure(scene, out, paths=2000000):
    costs = {"scene": os.path.basename(scene)}
    with tempfile.TemporaryDirectory() as folder:
        at = lambda name: os.path.join(folder, name)
        runs = {}
        for count in (paths // 4, paths):
            file = at(f"{count}.photons")
            shard = at(f"{count}-1.photons")
            other = at(f"{count}-2.photons")
            whole = ["phos-photons", scene, "--photons", str(count), "--caustic-photons", "0"]
            traced = spent(*whole, "--shard", "1/2", "-o", shard)
            spent(*whole, "--shard", "2/2", "-o", other)
            merged = spent("phos-merge", shard, other, "-o", file)
            alone = spent(*whole, "-o", file)
            runs[count] = (traced, merged, os.path.getsize(shard) + os.path.getsize(other), os.path.getsize(file), alone)
        few, many = sorted(runs)
        a, b = runs[few], runs[many]
        costs["photons"] = {"seconds": line(a[0][0], b[0][0], few / 2, many / 2), "memory": line(a[0][1], b[0][1], few / 2, many / 2),
                            "bytes": line(a[2] / 2, b[2] / 2, few / 2, many / 2)}
        # a merge sorts its photons into a tree: n log2 n
        grow = lambda n: n * math.log2(n)
        costs["merge_photons"] = {"seconds": line(a[1][0], b[1][0], grow(few), grow(many)), "memory": line(a[1][1], b[1][1], few, many),
                                  "bytes": line(a[3], b[3], few, many)}
        # one run alone traces its paths and makes the tree
        excess = lambda run, n: max(run[4][0] - at_cost(costs["photons"]["seconds"], n), 0)
        costs["tree"] = {"seconds": line(excess(a, few), excess(b, many), grow(few), grow(many)), "memory": line(a[4][1], b[4][1], few, many)}
        source = at("source.irradiance")
        spent("phos-irradiance", scene, at(f"{few}.photons"), "--place", "surface", "--accuracy", "0.3", "-o", source)
        box = json.loads(subprocess.run(["phos-scene", scene, "--json"], capture_output=True, text=True, check=True).stdout)["bounds_m"]
        seen = {}
        for side in (10, 30):
            points = at(f"{side}.csv")
            with open(points, "w", encoding="utf-8") as file:
                file.write("x,y,z,nx,ny,nz\n")
                for i in range(side * side):
                    u, v = (0.1 + 0.8 * (k + 0.5) / side for k in divmod(i, side))
                    file.write(f"{box[0][0] + u * (box[1][0] - box[0][0])},{0.5 * (box[0][1] + box[1][1])},{box[0][2] + v * (box[1][2] - box[0][2])},0,1,0\n")
            records, parts = at(f"{side}.irradiance"), [at(f"{side}-{k}.irradiance") for k in (1, 2)]
            ask = ["phos-irradiance", scene, source, "--place", "every", "--at", points, "--estimate", "gather", "--rays", "256", "--accuracy", "0.02"]
            gathered = spent(*ask, "--part", "1/2", "-o", parts[0])
            spent(*ask, "--part", "2/2", "-o", parts[1])
            merged = spent("phos-merge", *parts, "-o", records)
            read = spent("phos-sense", scene, records, "--points", points, "-o", at("read.csv"))
            seen[side * side] = (gathered, merged, read, sum(map(os.path.getsize, parts)), os.path.getsize(records), os.path.getsize(source))
        few, many = sorted(seen)
        a, b = seen[few], seen[many]
        rays = 256
        made = line(a[0][0], b[0][0], few / 2 * rays, many / 2 * rays)
        costs["sensors"] = {"seconds": made, "memory": line(a[0][1], b[0][1], few / 2, many / 2), "bytes": line(a[3] / 2, b[3] / 2, few / 2, many / 2),
                            "source_bytes": a[5]}
        costs["merge_sensors"] = {"seconds": line(a[1][0], b[1][0], few, many), "memory": line(a[1][1], b[1][1], few, many), "bytes": line(a[4], b[4], few, many)}
        costs["read"] = {"seconds": line(a[2][0], b[2][0], few, many), "memory": line(a[2][1], b[2][1], few, many)}
    with open(out, "w", encoding="utf-8") as file:
        json.dump(costs, file, indent=1)
        file.write("\n")
    print(f"costs: {out}")


# --- predict

def at_cost(cost, items):
    return cost["fixed"] + cost["each"] * items


class Site:
    def __init__(self, nodes, start, node_MBps, disk_MBps):
        self.nodes, self.start = nodes, start
        self.node, self.disk = node_MBps * 1e6, disk_MBps * 1e6

    def level(self, jobs):
        """Seconds that jobs, each (seconds, bytes moved), take on the nodes: each goes to the node that is free first."""
        busy = min(self.nodes, len(jobs))
        speed = min(self.node, self.disk / busy)  # the shared disk serves all busy nodes alike
        free = [0.0] * busy
        heapq.heapify(free)
        for seconds, moved in jobs:
            heapq.heappush(free, heapq.heappop(free) + self.start + seconds + moved / speed)
        return max(free)


def simulate(costs, photons, sensors, rays, cores, shards, parts, site):
    """Seconds of each level, peak bytes of memory of each stage, and bytes moved."""
    p, m = costs["photons"], costs["merge_photons"]
    share = photons / shards
    shard_bytes, map_bytes = at_cost(p["bytes"], share), at_cost(m["bytes"], photons)
    grown = photons * math.log2(max(photons, 2))
    if shards == 1:
        shard_bytes = map_bytes
        times = {"photons": site.level([(at_cost(p["seconds"], photons) / cores + at_cost(costs["tree"]["seconds"], grown), map_bytes)])}
        memory = {"photons": at_cost(costs["tree"]["memory"], photons)}
    else:
        times = {"photons": site.level([(at_cost(p["seconds"], share) / cores, shard_bytes)] * shards)}
        memory = {"photons": at_cost(p["memory"], share)}
    moved = shard_bytes * shards
    if shards > 1:
        times["merge_photons"] = site.level([(at_cost(m["seconds"], grown), shard_bytes * shards + map_bytes)])
        memory["merge_photons"] = at_cost(m["memory"], photons)
        moved += shard_bytes * shards + map_bytes
    if sensors:
        s, ms, r = costs["sensors"], costs["merge_sensors"], costs["read"]
        share = sensors / parts
        part_bytes = at_cost(s["bytes"], share)
        times["sensors"] = site.level([((at_cost(s["seconds"], share * rays)) / cores, s["source_bytes"] + part_bytes)] * parts)
        memory["sensors"] = at_cost(s["memory"], share)
        moved += (s["source_bytes"] + part_bytes) * parts
        if parts > 1:
            whole = at_cost(ms["bytes"], sensors)
            times["merge_sensors"] = site.level([(at_cost(ms["seconds"], sensors), part_bytes * parts + whole)])
            memory["merge_sensors"] = at_cost(ms["memory"], sensors)
            moved += part_bytes * parts + whole
        times["read"] = site.level([(at_cost(r["seconds"], share) / cores, at_cost(ms["bytes"], sensors))] * parts)
        memory["read"] = at_cost(r["memory"], sensors)
        moved += at_cost(ms["bytes"], sensors) * parts
    return times, memory, moved


def load(path):
    try:
        with open(path, encoding="utf-8") as file:
            costs = json.load(file)
        for stage in ("photons", "merge_photons", "tree", "sensors", "merge_sensors", "read"):
            costs[stage]["seconds"]["each"] + costs[stage]["memory"]["each"]
        return costs
    except OSError as error:
        raise Problem(f"{path}: {error.strerror}", 3) from None
    except (ValueError, KeyError, TypeError):
        raise Problem(f"{path}: holds no costs; make it with  cost.py measure SCENE {path}", 3) from None


def predict(path, photons=(1e6, 1e7, 1e8, 1e9, 1e10), nodes=(1, 10, 100, 1000), sensors=100000, rays=1024, cores=1, memory=64, node_MBps=1000,
            disk_MBps=5000, start=2, shards=0):
    costs = load(path)
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow("photons,nodes,seconds,speedup,merge_share,photons_s,merge_photons_s,sensors_s,merge_sensors_s,read_s,peak_GB,peak_stage,moved_GB,fits".split(","))
    for count in photons:
        alone = None
        for number in nodes:
            pieces = int(shards or number)
            site = Site(int(number), start, node_MBps, disk_MBps)
            times, need, moved = simulate(costs, count, sensors, rays, cores, pieces, pieces, site)
            total = sum(times.values())
            if alone is None:
                one = simulate(costs, count, sensors, rays, cores, 1, 1, Site(1, start, node_MBps, disk_MBps))
                alone = sum(one[0].values())
            worst = max(need, key=need.get)
            share = (times.get("merge_photons", 0) + times.get("merge_sensors", 0)) / total
            table.writerow([f"{count:.0f}", int(number), f"{total:.1f}", f"{alone / total:.2f}", f"{share:.3f}",
                            *(f"{times.get(stage, 0):.1f}" for stage in ("photons", "merge_photons", "sensors", "merge_sensors", "read")),
                            f"{need[worst] / 1e9:.2f}", worst, f"{moved / 1e9:.2f}", "yes" if need[worst] <= memory * 1e9 else worst])


# --- compare

def compare(path, folder):
    costs = load(path)
    rows = {}
    try:
        with open(os.path.join(folder, "log/jobs.csv"), encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if row["code"] == "0":
                    rows[row["job"]] = row
    except OSError as error:
        raise Problem(f"{error.filename}: {error.strerror}; FOLDER is that of a finished pipelines/cluster.sh", 3) from None
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(("stage", "jobs", "measured_s", "predicted_s", "ratio"))
    for stage, measured, foretold, count in _stages(costs, rows, folder):
        table.writerow((stage, count, f"{measured:.2f}", f"{foretold:.2f}", f"{foretold / measured:.2f}" if measured else ""))


def _stages(costs, rows, folder):
    """CPU seconds of stages, measured and foretold."""
    sums = {}
    for name, row in rows.items():
        with open(os.path.join(folder, f"jobs/{name}.json"), encoding="utf-8") as file:
            words = json.load(file)["command"]
        stage, ending = name.split("/")[0], os.path.splitext(name)[1]
        value = lambda option, default: words[words.index(option) + 1] if option in words else default
        if stage == "photons":
            part = 1 / int(str(value("--shard", "1/1")).split("/")[1])
            foretold, key = at_cost(costs["photons"]["seconds"], float(value("--photons", 1000000)) * part), "photons"
        elif stage == "merge" and ending == ".photons":
            count = (int(row["bytes_written"]) - costs["merge_photons"]["bytes"]["fixed"]) / costs["merge_photons"]["bytes"]["each"]
            m = costs["merge_photons"]["seconds"]
            foretold, key = m["fixed"] + m["each"] * count * math.log2(max(count, 2)), "merge_photons"
        elif stage == "irradiance" and "every" in words:
            part = 1 / int(str(value("--part", "1/1")).split("/")[1])
            with open(value("--at", os.devnull), encoding="utf-8") as file:
                count = sum(1 for _ in file) - 1
            foretold, key = at_cost(costs["sensors"]["seconds"], count * part * float(value("--rays", 1024))), "sensors"
        elif stage == "sense":
            part = 1 / int(str(value("--part", "1/1")).split("/")[1])
            with open(value("--points", os.devnull), encoding="utf-8") as file:
                count = sum(1 for _ in file) - 1
            foretold, key = at_cost(costs["read"]["seconds"], count * part), "read"
        else:
            continue
        measured, predicted, number = sums.get(key, (0, 0, 0))
        sums[key] = (measured + float(row["cpu_seconds"]), predicted + foretold, number + 1)
    return [(key, *value) for key, value in sums.items()]


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
        if not numbers or not all(math.isfinite(n) and n >= (1 if lists or name in ("cores", "paths") else 0) for n in numbers) or len(numbers) > 1 and not lists:
            raise Problem(f"{words[i]} {words[i + 1]}: give {'numbers of at least 1, comma by comma' if lists else 'a number'}")
        found[name] = numbers if lists else numbers[0]
    return found


def start():
    words = sys.argv[1:]
    if not words or words[0] in ("-h", "--help"):
        print(__doc__.strip(), file=sys.stdout if words else sys.stderr)
        return 0 if words else 2
    if words[0] == "measure" and len(words) >= 3:
        paths = int(options(words[3:], ["paths"]).get("paths", 2000000))
        if not os.path.isfile(words[1]):
            raise Problem(f"{words[1]}: no such file", 3)
        measure(words[1], words[2], max(paths, 1000))
    elif words[0] == "predict" and len(words) >= 2:
        predict(words[1], **options(words[2:], ["photons", "nodes", "sensors", "rays", "cores", "memory", "node_MBps", "disk_MBps", "start", "shards"]))
    elif words[0] == "compare" and len(words) == 3:
        compare(words[1], words[2])
    else:
        raise Problem(f'"{words[0]}": give measure SCENE FILE, predict FILE or compare FILE FOLDER; see cost.py --help')
    return 0


if __name__ == "__main__":
    main("cost.py", start)
