"""A run on many machines, simulated from the costs of its stages."""
import heapq

from costs.measure import n_log_n

MOST_PHOTONS = 2**31 - 1  # of a map (phos help limits)
IN_MEMORY = 112  # bytes of memory that phos-merge counts for a photon before it sorts on disk (kBytesOfMergeInMemory)
PROGRAM = 40 * 2**20  # bytes of phos-merge itself (kMemoryOfProgram)
# Bytes that a merge on disk moves for a photon, besides shards and map: its row, written and read, and its point and node in the tree, each three times.
MOVED_ON_DISK = 2 * 48 + 3 * (16 + 9)
SHARDS_READ, MAP_MOVED = 3.3, 4  # shards are checked, numbered and read; columns are written, hashed, read and written


def at_cost(cost, items, among=0):
    """Of `items`, each of which meets `among` others."""
    return cost["fixed"] + (cost["each"] + cost.get("pair", 0) * among) * items


def merges_on_disk(stored, memory_bytes):
    """Does phos-merge with --memory sort so many photons on disk?"""
    return stored * IN_MEMORY > memory_bytes - PROGRAM


class Site:
    """Nodes with cores and memory, a queue that takes `start` seconds for a job, and a shared disk."""

    def __init__(self, nodes, cores=1, memory_GB=64, start=2, node_MBps=1000, disk_MBps=5000):
        self.nodes, self.cores, self.memory, self.start = nodes, cores, memory_GB * 1e9, start
        self.node, self.disk = node_MBps * 1e6, disk_MBps * 1e6

    def level(self, jobs):
        """Seconds that jobs, each (seconds, bytes moved), take on the nodes: each goes to the node that is free first."""
        busy = min(self.nodes, len(jobs))
        speed = min(self.node, self.disk / busy)  # the shared disk serves all busy nodes alike
        free = [0.0] * busy
        for seconds, moved in jobs:
            heapq.heapreplace(free, free[0] + self.start + seconds + moved / speed)
        return max(free)


class Run:
    """Seconds of each stage, peak bytes of memory of a job of it, bytes moved, and what cannot be done."""

    def __init__(self, costs, site):
        self.costs, self.site = costs, site
        self.seconds, self.memory, self.moved, self.breaks = {}, {}, 0, ""

    def add(self, stage, jobs, memory):
        self.seconds[stage] = self.site.level(jobs)
        self.memory[stage] = memory
        self.moved += sum(moved for _, moved in jobs)
        if memory > self.site.memory and not self.breaks:
            self.breaks = stage

    def total(self):
        return sum(self.seconds.values())

    def merge_share(self):
        return (self.seconds.get("merge_photons", 0) + self.seconds.get("merge_sensors", 0)) / self.total()


def simulate(costs, photons, sensors, rays, pieces, site):
    """A run of `photons` paths and `sensors` in `pieces` shards and parts: photons, merge, source, sensors, merge, reading."""
    run = Run(costs, site)
    _add_photons(run, photons, pieces)
    if sensors:
        _add_sensors(run, photons, sensors, rays, pieces)
    if photons * costs["stored_per_path"] > MOST_PHOTONS:
        run.breaks = "one map holds too few photons"
    return run


def _add_photons(run, photons, shards):
    costs, site = run.costs, run.site
    p, m, share = costs["photons"], costs["merge_photons"], photons / shards
    whole, part, grown = at_cost(m["bytes"], photons), at_cost(p["bytes"], share), n_log_n(photons)
    traced = at_cost(p["seconds"], share) / site.cores
    if shards == 1:
        run.add("photons", [(traced + at_cost(costs["tree"]["seconds"], grown), whole)], at_cost(costs["tree"]["memory"], photons))
        return
    run.add("photons", [(traced, part)] * shards, at_cost(p["memory"], share))
    stored = photons * costs["stored_per_path"]
    if merges_on_disk(stored, site.memory):
        moved = SHARDS_READ * part * shards + MOVED_ON_DISK * stored + MAP_MOVED * whole
        run.add("merge_photons", [(at_cost(costs["merge_on_disk"]["seconds"], grown), moved)], site.memory)
    else:
        run.add("merge_photons", [(at_cost(m["seconds"], grown), part * shards + whole)], at_cost(m["memory"], photons))


def _add_sensors(run, photons, sensors, rays, parts):
    costs, site = run.costs, run.site
    source, s, ms, r = costs["source"], costs["sensors"], costs["merge_sensors"], costs["read"]
    share, source_bytes, whole = sensors / parts, at_cost(costs["source"]["bytes"], 0), at_cost(costs["merge_sensors"]["bytes"], sensors)
    part = at_cost(s["bytes"], share)
    run.add("source", [(at_cost(source["seconds"], photons) / site.cores, at_cost(costs["merge_photons"]["bytes"], photons) + source_bytes)],
            at_cost(source["memory"], photons))
    run.add("sensors", [(at_cost(s["seconds"], share * rays) / site.cores, source_bytes + part)] * parts, at_cost(s["memory"], share))
    if parts > 1:
        run.add("merge_sensors", [(at_cost(ms["seconds"], sensors), part * parts + whole)], at_cost(ms["memory"], sensors))
    run.add("read", [(at_cost(r["seconds"], share, sensors) / site.cores, whole)] * parts, at_cost(r["memory"], sensors))
