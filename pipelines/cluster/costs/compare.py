"""What a finished run took, stage by stage, beside its prediction."""
import csv
import json
import os

from costs.measure import n_log_n
from costs.model import at_cost, merges_on_disk
from problem import Problem
from runner import SHARE_OF_MERGE


def compare(costs, folder):
    """Rows (stage, jobs, measured seconds of the processor, predicted, measured peak of memory in bytes, predicted); the last is the sum of all."""
    sums = {}
    for name, row in _finished(folder).items():
        with open(os.path.join(folder, f"jobs/{name}.json"), encoding="utf-8") as file:
            job = json.load(file)
        stage, seconds, memory = _predicted(costs, name, job, row)
        if stage is None:
            continue
        one = sums.setdefault(stage, [0, 0.0, 0.0, 0, 0])
        one[0] += 1
        one[1] += float(row["cpu_seconds"])
        one[2] += seconds
        one[3], one[4] = max(one[3], float(row["peak_MB"]) * 2**20), max(one[4], memory)
    if not sums:
        raise Problem(f"{folder}: no job of this run is of a stage that is foretold: photons, their merge, records of sensors and their reading", 3)
    total = [sum(one[i] for one in sums.values()) for i in range(3)] + [max(one[i] for one in sums.values()) for i in (3, 4)]
    return [(stage, *one) for stage, one in sums.items()] + [("all", *total)]


def _finished(folder):
    try:
        with open(os.path.join(folder, "log/jobs.csv"), encoding="utf-8") as file:
            return {row["job"]: row for row in csv.DictReader(file) if row["code"] == "0"}
    except OSError as error:
        raise Problem(f"{error.filename}: {error.strerror}; FOLDER is that of a finished pipelines/cluster.sh", 3) from None


def _predicted(costs, name, job, row):
    """Stage, seconds and bytes of memory of one job; no stage where none of the costs is for it."""
    words, stage, ending = job["command"], name.split("/")[0], os.path.splitext(name)[1]
    value = lambda option, default: words[words.index(option) + 1] if option in words else default
    part = 1 / int(value("--shard", value("--part", "1/1")).split("/")[1])
    cost = lambda key, items, grown=None, among=0: (key, at_cost(costs[key]["seconds"], items if grown is None else grown, among),
                                                    at_cost(costs[key]["memory"], items))
    if stage == "photons":
        paths = float(value("--photons", 1000000))
        key, seconds, memory = cost("photons", paths * part)
        return (key, seconds, memory) if part < 1 else (key, seconds + cost("tree", paths, n_log_n(paths))[1], cost("tree", paths)[2])
    paths_of = lambda map_bytes: max((int(map_bytes) - costs["merge_photons"]["bytes"]["fixed"]) / costs["merge_photons"]["bytes"]["each"], 0)
    if stage == "merge" and ending == ".photons":
        paths = paths_of(row["bytes_written"])
        most = job["memory"] * SHARE_OF_MERGE * 2**20
        if merges_on_disk(paths * costs["stored_per_path"], most):
            return ("merge_on_disk", cost("merge_on_disk", 0, n_log_n(paths))[1], most)
        return cost("merge_photons", paths, n_log_n(paths))
    if stage == "irradiance" and "every" in words:
        sensors = _rows(value("--at", os.devnull)) * part
        key, seconds, _ = cost("sensors", sensors * float(value("--rays", 1024)))
        return key, seconds, cost("sensors", sensors)[2]
    if stage == "irradiance" and "surface" in words:
        return cost("source", paths_of(row["bytes_read"]))
    if stage == "merge":
        sensors = (int(row["bytes_written"]) - costs["merge_sensors"]["bytes"]["fixed"]) / costs["merge_sensors"]["bytes"]["each"]
        return cost("merge_sensors", sensors)
    if stage == "sense":
        sensors = _rows(value("--points", os.devnull))
        return cost("read", sensors * part, among=sensors)
    return None, 0, 0


def _rows(path):
    with open(path, encoding="utf-8") as file:
        return sum(1 for _ in file) - 1
