"""The folder of a run, which all machines see: store/STAGE/KEY (files of jobs), jobs/ (commands), log/, results/ (links into store)."""
import csv
import json
import os
import secrets

from jobs import FOLDERS, Job, Scene
from problem import Problem

DEFAULTS = {"threads": 1, "memory": 2048, "minutes": 240}
TOKEN = ".shared"  # a file by which a node tells whether it sees the folder


class Folder:
    def __init__(self, path):
        self.path = os.path.realpath(path)

    def __truediv__(self, name):
        return os.path.join(self.path, name)

    def store(self, name):
        return os.path.join(self.path, "store", name)

    def is_done(self, name):
        return os.path.exists(self.store(name))

    def create(self):
        try:
            for name in ("store", "jobs", "log", "results"):
                os.makedirs(self / name, exist_ok=True)
            if not os.path.exists(self / TOKEN):
                write_whole(self / TOKEN, secrets.token_hex(8) + "\n")
        except OSError as error:
            raise Problem(f"{error.filename}: {error.strerror}", 3) from None

    def token(self):
        try:
            with open(self / TOKEN, encoding="utf-8") as file:
                return file.read().strip()
        except OSError:
            raise Problem(f"{self.path}: is not the folder of a run, or is not shared with {os.uname().nodename}; give a folder on a file system "
                          "that all machines mount at the same path", 3) from None

    def write_jobs(self, graph):
        """Writes the command of each job, where it is not there yet."""
        for job in graph.jobs.values():
            text = json.dumps(self.described(job, graph), indent=1) + "\n"
            path = self / f"jobs/{job.name}.json"
            if not os.path.exists(path) or read(path) != text:
                os.makedirs(os.path.dirname(path), exist_ok=True)
                write_whole(path, text)

    def described(self, job, graph):
        resource = {name: graph.configuration.resource(job.stage, name, value) for name, value in DEFAULTS.items()}
        words = [self.store(w.name) if isinstance(w, Job) else w.path if isinstance(w, Scene) else w for w in job.words]
        return {"command": [job.program, *words], "needs": [need.name for need in job.needs], "folder": job.stage in FOLDERS, **resource}

    def job(self, name):
        path = self / f"jobs/{name}.json"
        try:
            return json.loads(read(path))
        except OSError:
            raise Problem(f"{path}: no such job; run  cluster.py plan CONFIG {self.path}", 3) from None

    def publish(self, graph):
        """Links the results under readable names, and writes results.csv. Throws where one is missing."""
        missing = [path for path, job in graph.results.items() if not self.is_done(job.name)]
        if missing:
            raise Problem(f"{len(missing)} of {len(graph.results)} results are missing, the first is {missing[0]}: {self.why_missing(graph, missing[0])}", 3)
        rows = []
        for path, job in graph.results.items():
            source = self.store(job.name)
            target = os.path.dirname(path) if job.stage == "frames" else path  # frames of a film lie together
            for file in sorted(_files_below(source)) if job.stage in FOLDERS else [""]:
                _link(os.path.join(source, file) if file else source, self / os.path.join("results", target, file).rstrip("/"))
            rows.append((path, job.name))
        with open(self / "results/results.csv.new", "w", encoding="utf-8", newline="") as out:
            table = csv.writer(out, lineterminator="\n")
            table.writerow(("result", "file"))
            table.writerows(rows)
        os.replace(self / "results/results.csv.new", self / "results/results.csv")
        return len(rows)

    def why_missing(self, graph, result):
        """The first job before the result that has no file, and the last line that it said."""
        for job in first_missing(graph.results[result], self):
            log = self / f"log/{job.name}.log"
            said = [line for line in read(log).splitlines() if line.strip()] if os.path.exists(log) else []
            return f"{job.name} has no file" + (f"; it said: {said[-1]} ({log})" if said else "; it left no log: it did not start, or its node does not see this folder")
        return "it is there now"


def first_missing(job, folder):
    """Missing jobs that `job` needs, earliest first, each once."""
    order, seen = [], set()

    def look(one):
        if one.name in seen or folder.is_done(one.name):
            return
        seen.add(one.name)
        for need in one.needs:
            look(need)
        order.append(one)

    look(job)
    return order


def to_do(graph, folder):
    """Jobs whose files are missing and needed, earliest first. Files that only done jobs read are not made again."""
    order = {}
    for job in graph.results.values():
        for one in first_missing(job, folder):
            order[one.name] = one
    return list(order.values())


def read(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        return file.read()


def write_whole(path, text):
    new = f"{path}.{os.uname().nodename}-{os.getpid()}.new"
    with open(new, "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(new, path)


def _files_below(folder):
    for at, _, names in os.walk(folder):
        for name in names:
            yield os.path.relpath(os.path.join(at, name), folder)


def _link(source, target):
    if os.path.exists(target) and os.path.samefile(source, target):
        return
    os.makedirs(os.path.dirname(target), exist_ok=True)
    new = f"{target}.{os.getpid()}.new"
    os.symlink(os.path.relpath(source, os.path.dirname(target)), new)
    os.replace(new, target)
