"""Is what phos-plan chose the best there is? Settings around those of its last round, by phos-study:
    tests/bench/plan_best.py [--whole | --alone] FOLDER SCENE PERCENT...
FOLDER is that of plan_table.sh, which ran the plans and made the references. All settings of photons and records are tried with the
plan's picture, and all of the picture with the plan's records; mean squares of errors and seconds of the two add up, and of the
settings that this promises to be faster the first few are run until one holds. --whole: every setting with every other (hours).
--alone: each setting by itself (a third of the time), and then what their gains together promise.
A line for each error asked for: how many settings were run; error and seconds of the plan's; those of the fastest that was seen to
meet what was asked; and how many times its seconds the plan's settings took there, and all rounds of the plan when it ran. Programs
from PATH or build/release/bin; studies stay in FOLDER and are not run again."""

import csv
import itertools
import json
import math
import os
import pathlib
import subprocess
import sys

# Of each option that trades time for error, multiples of the plan's value.
LEVELS = {
    "photons": (0.5, 1, 2),
    "accuracy": (1 / 1.4, 1, 1.4),
    "rays": (0.5, 1, 2),
    "edge_samples": (0.5, 1),
    "light_samples": (0.25, 0.5, 1, 2),
    "gloss_samples": (0.5, 1, 2),
}
MOST_TRIES = 4


def number(word):
    try:
        return int(word)
    except ValueError:
        return float(word)


def whole_rings(rays):
    """The number next to it of rays that fill the rings of a hemisphere."""
    return min((n * round(math.pi * n) for n in range(2, 200)), key=lambda cells: abs(cells - rays))


def near(key, value):
    if key == "accuracy":
        return sorted({float(f"{f * value:.4g}") for f in LEVELS[key]})
    return sorted({whole_rings(f * value) if key == "rays" else max(1, round(f * value)) for f in LEVELS[key]})


class Case:
    """What was asked of one plan, and the studies of it."""

    def __init__(self, folder, scene, percent):
        self.name = pathlib.Path(scene).stem
        self.base = folder / f"best_{self.name}_{percent}"
        self.plan = json.loads((folder / f"run_{self.name}_{percent}/plan.json").read_text())
        self.references = [str(folder / f"ref_{self.name}_{seed}.exr") for seed in (1, 2)]
        self.fixed = {}  # all options of each tool
        self.own = {}  # of those, the plan's value of what LEVELS names
        for stage in self.plan["stages"]:
            tool, words = stage["tool"].removeprefix("phos-"), stage["arguments"]
            self.fixed[tool] = {}
            for word, value in zip(words, words[1:]):
                key = word[2:].replace("-", "_")
                if not word.startswith("--") or key in ("width", "height"):
                    continue
                if key in LEVELS:
                    self.own[tool, key] = number(value)
                plain = value.replace(".", "", 1).isdigit()
                self.fixed[tool][key] = True if value.startswith("-") else number(value) if plain else value

    def study(self, suffix, values):
        """Rows of the study of these values of options: (values, error, seconds)."""
        lines = [
            "[study]",
            f"scenes = {json.dumps(str(pathlib.Path(self.plan['scene']).resolve()))}",
            f"width = {self.plan['size'][0]}\nheight = {self.plan['size'][1]}\nrepeats = 1\nignore_lamps = true",
            f"[reference]\nfiles = {json.dumps(self.references)}",
        ]
        for tool, options in self.fixed.items():
            lines.append(f"[{tool}]")
            lines += [f"{key} = {json.dumps(values.get((tool, key), value))}" for key, value in options.items()]
        out = self.base.with_name(self.base.name + suffix)
        out.with_suffix(".toml").write_text("\n".join(lines) + "\n")
        command = ["phos-study", out.with_suffix(".toml"), "-o", out, "--pictures", "0", "--quiet", "--discard"]
        subprocess.run(command, check=True)
        with open(out / "results.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        found = {}
        for row in rows:
            # A column for each option of several values.
            read = lambda tool, key: float(row.get(f"{tool}.{key.replace('_', '-')}") or single(values.get((tool, key))) or self.own[tool, key])
            at = tuple(read(*which) for which in self.own)
            found[at] = (float(row["picture_error"] or "inf"), float(row["picture_seconds"] or "inf"))
        return found


def single(values):
    return values[0] if isinstance(values, list) else values


def search(case, asked, alone):
    """All settings that were run, and the plan's own."""
    own = tuple(float(v) for v in case.own.values())
    levels = {which: near(which[1], v) for which, v in case.own.items()}
    kinds = [which if alone else which[0] == "splat" for which in levels]
    order = list(dict.fromkeys(kinds))
    studies = []  # of each kind: what was found, with the rest as the plan has it
    for kind in order:
        values = {which: v for (which, v), k in zip(levels.items(), kinds) if k == kind}
        suffix = f"_{kind[1]}" if alone else "_picture" if kind else "_records"
        studies.append(case.study(suffix, values))
    found = {own: studies[0][own]}
    for study in studies:
        found |= {at: result for at, result in study.items() if at != own}
    promised = []
    for combined in itertools.product(*studies):
        at = tuple(combined[order.index(kind)][i] for i, kind in enumerate(kinds))
        gains = [(s[c][0] ** 2 - s[own][0] ** 2, s[c][1] - s[own][1]) for s, c in zip(studies, combined)]
        error2, seconds = found[own][0] ** 2 + sum(g[0] for g in gains), found[own][1] + sum(g[1] for g in gains)
        if error2 <= asked**2 and at not in found:
            promised.append((seconds, at))
    for tries, (seconds, at) in enumerate(sorted(promised)[:MOST_TRIES]):
        if seconds > min((s for e, s in found.values() if e <= asked), default=float("inf")):
            break
        found |= case.study(f"_try{tries}", {which: [number(f"{v:g}")] if v != round(v) else [round(v)] for which, v in zip(case.own, at)})
    return found, own


def judge(folder, scene, percent, mode):
    case, asked = Case(folder, scene, percent), float(percent) / 100
    if mode == "--whole":
        own = tuple(float(v) for v in case.own.values())
        found = case.study("", {which: near(which[1], v) for which, v in case.own.items()})
    else:
        found, own = search(case, asked, mode == "--alone")
    chosen = found[own]
    at, best = min(((k, v) for k, v in found.items() if v[0] <= asked), key=lambda x: x[1][1], default=(own, chosen))
    rounds = [r["seconds"] for r in case.plan["run"]["rounds"]]
    where = " ".join(f"{key} {v:g}" for (tool, key), v in zip(case.own, at))
    print(
        f"{case.name:28} {percent:>3} %  {len(found):4}  {chosen[0]:7.2%} {chosen[1]:6.1f} s  {best[0]:7.2%}"
        f" {best[1]:6.1f} s  {chosen[1] / best[1]:5.2f} {sum(rounds) / best[1]:5.2f}  {where}",
        flush=True,
    )


if __name__ == "__main__":
    arguments = sys.argv[1:]
    mode = arguments.pop(0) if arguments[:1] in (["--whole"], ["--alone"]) else ""
    if len(arguments) < 3 or arguments[0].startswith("-"):
        sys.exit(__doc__)
    os.environ["PATH"] += os.pathsep + str(pathlib.Path(__file__).resolve().parents[2] / "build/release/bin")
    print(f"{'scene':28} asked     n             plan               best   last   all  the best's")
    for percent in arguments[2:]:
        judge(pathlib.Path(arguments[0]).resolve(), arguments[1], percent, mode)
