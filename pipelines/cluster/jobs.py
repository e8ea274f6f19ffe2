"""The jobs of a configuration, each named by the key of its contents.

The key of a job is made of its program's bytes, of its options, of the contents of the files that these name, and of the keys of the jobs whose
files it reads. A job's file stands in FOLDER/store/STAGE/KEY.ENDING; the job is done where it is there. Programs write a file whole or not at all.
Dates play no part.
"""
import hashlib
import json
import os
import shutil
import subprocess
import tomllib

from contents import content_key, scene_key
from problem import Problem, nearest
from words import with_files

JOIN = os.path.join(os.path.dirname(os.path.realpath(__file__)), "join.py")
FOLDERS = ("frames", "study")  # stages whose jobs make a folder


class Scene:
    """A scene file among the words of a job."""

    def __init__(self, path):
        self.path = path


class Job:
    """Words of a command: texts, Scenes and Jobs whose files it reads."""

    def __init__(self, stage, program, words, ending, also_key=()):
        self.stage = stage
        self.program = program
        self.words = words
        self.needs = [word for word in words if isinstance(word, Job)]
        parts = [stage, content_key(program), *map(_key_of, words), *also_key]
        self.key = hashlib.sha256(json.dumps(parts).encode()).hexdigest()[:32]
        self.name = f"{stage}/{self.key}{ending}"
        self.level = 1 + max((need.level for need in self.needs), default=0)


def _key_of(word):
    if isinstance(word, Job):
        return "job " + word.key
    if isinstance(word, Scene):
        return "scene " + scene_key(word.path)
    return "word " + with_files(word, "/", content_key)  # the configuration made files absolute


class Graph:
    """All jobs of a configuration: `jobs` by name, needed ones first, and `results`: path in FOLDER/results -> job."""

    def __init__(self, configuration):
        self.configuration = configuration
        self.jobs = {}
        self.results = {}
        self._programs = {}
        self._known_options = {}
        self._make_all()

    def of(self, name):
        return self.jobs[name]

    def _program(self, tool):
        if tool == JOIN:
            return tool
        if tool not in self._programs:
            path = shutil.which("phos-" + tool)
            if path is None:
                raise Problem(f"phos-{tool}: not on PATH; put the folder of the programs there", 3)
            self._programs[tool] = os.path.abspath(path)
        return self._programs[tool]

    def _checked(self, tool, options, where):
        """The options, after a look whether the program has all of them."""
        if tool not in self._known_options:
            told = subprocess.run([self._program(tool), "--options-json"], capture_output=True, text=True, check=False)
            if told.returncode != 0:
                raise Problem(f"phos-{tool}: cannot be run: {told.stderr.strip()}", 3)
            self._known_options[tool] = [option["name"] for option in json.loads(told.stdout)["options"]]
        for word in options:
            if word.startswith("--"):
                name = word[2:].partition("=")[0]
                if name not in self._known_options[tool]:
                    raise Problem(f"{self.configuration.path}: {where}: phos-{tool} has no option --{name}" + nearest(name, self._known_options[tool]))
                if name in ("output", "threads", "reuse", "why", "stats", "progress", "shard", "part", "frames", "add-to", "misses", "gloss-misses"):
                    raise Problem(f"{self.configuration.path}: {where}: --{name} is the workflow's own; leave it out")
        return options

    def _job(self, stage, tool, words, ending, also_key=()):
        job = Job(stage, self._program(tool), words, ending, also_key)
        return self.jobs.setdefault(job.name, job)

    def _merged(self, jobs, ending):
        return jobs[0] if len(jobs) == 1 else self._job("merge", "merge", jobs, ending)

    def _make_all(self):
        c = self.configuration
        for scene, scene_values in c.scenes.items():
            for condition, condition_values in c.conditions.items():
                light = scene_values.get("options", []) + condition_values.get("options", [])
                for setting, values in c.settings.items():
                    self._make(f"{scene}/{condition}/{setting}", Scene(scene_values["file"]), light, f"settings.{setting}", values)
        for name, values in c.studies.items():
            options = self._checked("study", values.get("options", []), f"studies.{name}")
            self.results[f"studies/{name}"] = self._job("study", "study", [values["file"], *options], "", _files_of_study(values["file"], c.path))

    def _make(self, at, scene, light, where, values):
        c = self.configuration
        files = _file_options(light)
        photons = None  # made where they are needed

        def all_photons():
            nonlocal photons
            if photons is None:
                words = [scene, *self._checked("photons", light + values.get("photons", []), where + ".photons")]
                count = values.get("shards", 1)
                shards = [self._job("photons", "photons", [*words, "--shard", f"{i}/{count}"] if count > 1 else words, ".photons")
                          for i in range(1, count + 1)]
                photons = self._merged(shards, ".photons")
            return photons

        def records(options, parts, where, read, ending=".irradiance"):
            words = [scene, *read, *files, *self._checked("irradiance", options, where + ".irradiance")]
            if parts > 1 and not _says(options, "place", "every"):
                raise Problem(f"{c.path}: {where}.parts: only records of --place every can be made in parts; leave parts out, or give irradiance "
                              "--place every --at FILE")
            made = [self._job("irradiance", "irradiance", [*words, "--part", f"{i}/{parts}"] if parts > 1 else words, ending)
                    for i in range(1, parts + 1)]
            return self._merged(made, ending)

        if c.pictures:
            for camera, camera_values in c.cameras.items():
                view = camera_values.get("options", [])
                options = values.get("irradiance", [])
                here = [*options, *view] if _says(options, "place", "view") else options
                caches = [records(here, values.get("parts", 1), where, [all_photons()])]
                lobes = [self._job("brdf", "brdf", [scene, *files, *self._checked("brdf", values["brdf"], where + ".brdf")], ".brdf")] if "brdf" in values else []
                if "radiance" in values:
                    options = values["radiance"]
                    here = [*options, *view] if _says(options, "place", "view") else options
                    caches.append(self._job("radiance", "radiance", [scene, all_photons(), *lobes, *files, *self._checked("radiance", here, where + ".radiance")], ".radiance"))
                self.results[f"{at}/{camera}.exr"] = self._job(
                    "splat", "splat", [scene, *caches, *lobes, *files, *self._checked("splat", view + values.get("splat", []), where + ".splat")], ".exr")
        for film, film_values in c.films.items():
            for camera, camera_values in c.cameras.items():
                view, name = camera_values.get("options", []), f"films.{film}"
                first, last = film_values["frames"]
                cache = self._job("temporal", "temporal", [scene, *self._checked("temporal", light + view + film_values.get("temporal", []), name + ".temporal"),
                                                           "--frames", f"{first}:{last}"], ".irradiance")
                words = [scene, cache, *files, *self._checked("splat", view + film_values.get("splat", []), name + ".splat")]
                step = film_values.get("frames_per_job", 10)
                for begin in range(first, last + 1, step):
                    end = min(begin + step - 1, last)
                    self.results[f"{at}/{film}-{camera}/{begin}-{end}"] = self._job("frames", "splat", [*words, "--frames", f"{begin}:{end}"], "")
        for grid, grid_values in c.grids.items():
            name = f"grids.{grid}"
            if "points" in grid_values:
                points, take = grid_values["points"], [grid_values["points"]]
            else:
                options = self._checked("sense", light + grid_values["grid"], name + ".grid")
                points = self._job("points", "sense", [scene, *options, "--direct-only", "--light-samples", "1"], ".csv")
                take = [points]
            read = [all_photons()]
            if "source" in grid_values:
                read = [records(grid_values["source"], 1, name + ".source", read)]
            sensors = ["--place", "every", "--at", *take, *grid_values.get("irradiance", ["--estimate", "gather"])]
            records_at = self._sensor_records(scene, read, files, sensors, grid_values.get("parts", 1), name)
            words = [scene, records_at, *files, "--points", *take, *self._checked("sense", grid_values.get("sense", []), name + ".sense")]
            count = grid_values.get("parts", 1)
            tables = [self._job("sense", "sense", [*words, "--part", f"{i}/{count}"] if count > 1 else words, ".csv") for i in range(1, count + 1)]
            self.results[f"{at}/{grid}.csv"] = tables[0] if count == 1 else self._job("join", JOIN, tables, ".csv")

    def _sensor_records(self, scene, read, files, options, parts, name):
        self._checked("irradiance", [word for word in options if isinstance(word, str)], name + ".irradiance")
        words = [scene, *read, *files, *options]
        made = [self._job("irradiance", "irradiance", [*words, "--part", f"{i}/{parts}"] if parts > 1 else words, ".irradiance")
                for i in range(1, parts + 1)]
        return self._merged(made, ".irradiance")


def _says(options, name, value):
    return any(word == f"--{name}={value}" or word == f"--{name}" and options[i + 1:i + 2] == [value] for i, word in enumerate(options))


def _file_options(options):
    """Options whose values are files: every stage needs them (as file_options in pipelines/common.sh)."""
    taken, names = [], ("--environment", "--luminaire", "--spectrum")
    for i, word in enumerate(options):
        if word in names:
            taken += options[i:i + 2]
        elif word.partition("=")[0] in names:
            taken.append(word)
    return taken


def _files_of_study(path, configuration):
    """Keys of the files that a study names."""
    try:
        with open(path, "rb") as file:
            tree = tomllib.load(file)
    except tomllib.TOMLDecodeError as error:
        raise Problem(f"{configuration}: {path}: is no TOML: {error}", 3) from None
    keys = []

    def look(value):
        if isinstance(value, dict):
            for name in sorted(value):
                look(value[name])
        elif isinstance(value, list):
            for one in value:
                look(one)
        elif isinstance(value, str):
            full = os.path.join(os.path.dirname(path), value.rpartition("=")[2])
            if value and os.path.isfile(full):
                keys.append(scene_key(os.path.realpath(full)))

    look(tree)
    return keys
