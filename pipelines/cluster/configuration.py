"""The configuration file of a run: scenes x conditions x cameras x settings, and what is made of them."""
import math
import os
import re
from datetime import datetime, timedelta, timezone

from problem import Problem, nearest
from words import words_of

STAGES = ("photons", "merge", "brdf", "radiance", "irradiance", "splat", "temporal", "frames", "points", "sense", "join", "study")

# What each section holds: its keys, and the kind of each value. "options" is a line of options of a program, as in a shell.
KEYS = {
    "scenes": {"file": "file", "options": "options"},
    "conditions": {"options": "options", "times": "times"},
    "cameras": {"options": "options"},
    "settings": {"photons": "options", "shards": "count", "irradiance": "options", "parts": "count", "radiance": "options",
                 "brdf": "options", "splat": "options"},
    "films": {"frames": "frames", "temporal": "options", "splat": "options", "frames_per_job": "count"},
    "grids": {"grid": "options", "points": "file", "source": "options", "irradiance": "options", "parts": "count", "sense": "options"},
    "studies": {"file": "file", "options": "options"},
    "resources": {"threads": "count", "memory": "memory", "minutes": "count"},
}
TIMES = ("from", "to", "every", "hours", "location")
NAMED_BY = {"scenes": "file", "conditions": "options", "cameras": "options", "studies": "file"}  # the key of a section that a bare value gives
ALONE = {"pictures"}


class Configuration:
    """Checked values: self.scenes["room"]["file"], a missing key is absent. Files are absolute paths, options are lists of words."""

    def __init__(self, path):
        self.path = path
        self.folder = os.path.dirname(os.path.abspath(path))
        tree = _load(path)
        if not isinstance(tree, dict):
            raise Problem(f"{path}: holds no keys; see pipelines/cluster/config.yaml")
        for key in tree:
            if key not in KEYS and key not in ALONE:
                raise Problem(f'{path}: "{key}": no such key{nearest(key, [*KEYS, *sorted(ALONE)])}')
        for section in KEYS:
            setattr(self, section, self._section(section, tree.get(section)))
        self.pictures = tree.get("pictures", False)
        if not isinstance(self.pictures, bool):
            raise self._wrong("pictures", "true or false", self.pictures)
        self.conditions = self._expanded() or {"plain": {}}
        self.cameras = self.cameras or {"first": {}}
        if not self.settings:
            self.settings = {"default": {}}
        if not self.scenes and not self.studies:
            raise Problem(f"{path}: scenes: name a scene, like  scenes: {{room: room.glb}}")
        if not (self.pictures or self.films or self.grids or self.studies):
            raise Problem(f"{path}: asks for nothing; give pictures: true, films, grids or studies")

    def resource(self, stage, name, default):
        return self.resources.get(stage, self.resources.get("every", {})).get(name, default)

    def _wrong(self, where, wanted, value):
        return Problem(f"{self.path}: {where}: give {wanted}, not {value!r}")

    def _section(self, section, tree):
        if tree is None:
            return {}
        if not isinstance(tree, dict):
            raise self._wrong(section, "names, each with its values", tree)
        made = {}
        for name, values in tree.items():
            name = str(name)
            where = f"{section}.{name}"
            if section == "resources" and name not in STAGES + ("every",):
                raise Problem(f'{self.path}: "{where}": no such stage{nearest(name, [*STAGES, "every"])}')
            if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_.+:-]*", name):
                raise Problem(f"{self.path}: {where}: names become names of files; use letters, digits, and . _ + : - inside")
            if not isinstance(values, dict):
                key = NAMED_BY.get(section)
                if key is None or isinstance(values, (list, int, float)):
                    raise self._wrong(where, "keys: " + ", ".join(KEYS[section]), values)
                values = {} if values is None else {key: values}
            made[name] = {}
            for key, value in values.items():
                if key not in KEYS[section]:
                    raise Problem(f'{self.path}: "{where}.{key}": no such key{nearest(key, list(KEYS[section]))}')
                made[name][key] = self._value(f"{where}.{key}", KEYS[section][key], value)
            if "file" in KEYS[section] and "file" not in made[name]:
                raise Problem(f"{self.path}: {where}: names no file")
            if section == "films" and "frames" not in made[name]:
                raise Problem(f"{self.path}: {where}: give frames: A:B")
            if section == "grids" and ("grid" in made[name]) == ("points" in made[name]):
                raise Problem(f"{self.path}: {where}: give grid (options of phos-sense) or points (a file), one of them")
        return made

    def _value(self, where, kind, value):
        if kind == "options":
            if value is None:
                return []
            if not isinstance(value, str):
                raise self._wrong(where, "options as one text", value)
            return words_of(value, self.folder, f"{self.path}: {where}")
        if kind == "file":
            path = os.path.join(self.folder, str(value))
            if not os.path.isfile(path):
                raise Problem(f"{self.path}: {where}: {value}: no such file (paths are counted from {self.folder})", 3)
            return os.path.realpath(path)
        if kind == "count":
            if isinstance(value, bool) or not isinstance(value, int) or not 1 <= value <= 1 << 20:
                raise self._wrong(where, "a whole number from 1 to 1048576", value)
            return value
        if kind == "memory":
            found = re.fullmatch(r"(\d+)([MG])", str(value))
            if not found:
                raise self._wrong(where, "memory like 500M or 4G", value)
            return int(found[1]) * (1024 if found[2] == "G" else 1)
        if kind == "frames":
            found = re.fullmatch(r"(\d+):(\d+)", str(value))
            if not found or int(found[1]) > int(found[2]):
                raise self._wrong(where, "first and last frame in quotes, like \"0:99\"", value)
            return int(found[1]), int(found[2])
        return self._times(where, value)

    def _times(self, where, value):
        if not isinstance(value, dict):
            raise self._wrong(where, "keys: " + ", ".join(TIMES), value)
        for key in value:
            if key not in TIMES:
                raise Problem(f'{self.path}: "{where}.{key}": no such key{nearest(key, list(TIMES))}')
        for key in ("from", "to", "location"):
            if key not in value:
                raise Problem(f"{self.path}: {where}: {key} is missing")
        try:
            first, last = (v if isinstance(v, datetime) else datetime.fromisoformat(str(v)) for v in (value["from"], value["to"]))
            if first.tzinfo is None or last.tzinfo is None:
                raise ValueError("a time has no zone")
            latitude, longitude = map(float, str(value["location"]).split(","))
            low, high = map(int, str(value.get("hours", "0-23")).split("-"))
        except ValueError as error:
            raise Problem(f'{self.path}: {where}: {error}; write times in quotes, like "2026-01-01T09:00+01:00", location: 52.5,13.4 and '
                          "hours: 8-18") from None
        every = self._value(f"{where}.every", "count", value.get("every", 60))
        times, at = [], first
        while at <= last:
            if low <= at.hour <= high and sun_elevation(at, latitude, longitude) > 0.1:
                times.append(at.isoformat(timespec="minutes"))
            at += timedelta(minutes=every)
        if not times:
            raise Problem(f"{self.path}: {where}: the sun is up at none of these times")
        return {"location": f"{latitude:g},{longitude:g}", "times": times}

    def _expanded(self):
        made = {}
        for name, values in self.conditions.items():
            options, times = values.get("options", []), values.get("times")
            if times is None:
                made[name] = options
                continue
            for time in times["times"]:
                made[f"{name}-{time[:16].replace(':', '')}"] = [*options, "--location", times["location"], "--when", time]
        return {name: {"options": options} for name, options in made.items()}


def sun_elevation(time, latitude, longitude):
    """Degrees of the sun's centre above the horizon, to about 0.02 degrees (Astronomical Almanac, low precision formula)."""
    days = (time.astimezone(timezone.utc) - datetime(2000, 1, 1, 12, tzinfo=timezone.utc)).total_seconds() / 86400
    anomaly = math.radians(357.528 + 0.9856003 * days)
    ecliptic = math.radians(280.460 + 0.9856474 * days + 1.915 * math.sin(anomaly) + 0.020 * math.sin(2 * anomaly))
    tilt = math.radians(23.439 - 4e-7 * days)
    right = math.atan2(math.cos(tilt) * math.sin(ecliptic), math.cos(ecliptic))
    declination = math.asin(math.sin(tilt) * math.sin(ecliptic))
    hour = math.radians(280.46061837 + 360.98564736629 * days + longitude) - right
    north = math.radians(latitude)
    return math.degrees(math.asin(math.sin(north) * math.sin(declination) + math.cos(north) * math.cos(declination) * math.cos(hour)))


def _load(path):
    try:
        import yaml
    except ImportError:
        raise Problem("python3-yaml: not installed; run pipelines/install.sh --cluster", 3) from None

    class Loader(yaml.SafeLoader):
        """Refuses a key that is given twice. Times and A:B stay texts."""

        def construct_mapping(self, node, deep=False):
            seen = set()
            for key, _ in node.value:
                name = self.construct_object(key)
                if name in seen:
                    raise Problem(f'{path}: line {key.start_mark.line + 1}: "{name}" is given twice')
                seen.add(name)
            return super().construct_mapping(node, deep)

    Loader.yaml_implicit_resolvers = {
        letter: [(tag, pattern) for tag, pattern in found if tag != "tag:yaml.org,2002:timestamp"]
        for letter, found in yaml.SafeLoader.yaml_implicit_resolvers.items()}
    try:
        with open(path, encoding="utf-8") as file:
            return yaml.load(file, Loader)
    except OSError as error:
        raise Problem(f"{path}: {error.strerror}", 3) from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise Problem(f"{path}: is no YAML: {' '.join(str(error).split())}", 3) from None
