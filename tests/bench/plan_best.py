"""Is what phos-plan chose the best there is? Every setting around those of its last round, by phos-study:
    tests/bench/plan_best.py FOLDER SCENE PERCENT...
FOLDER is that of plan_table.sh, which ran the plans and made the references. A line for each error asked for: how many settings
there are; error and seconds of the plan's; those of the fastest that meets what was asked; and how many times its seconds the plan's
settings took there, and all rounds of the plan when it ran. Programs from PATH or build/release/bin; studies stay in FOLDER and are not run again."""

import csv
import json
import os
import pathlib
import subprocess
import sys

# Of each option that trades time for error, multiples of the plan's value.
LEVELS = {
    "photons": (0.5, 1),
    "accuracy": (1 / 1.4, 1, 1.4),
    "rays": (0.5, 1, 2),
    "edge_samples": (0.5, 1),
    "light_samples": (0.5, 1, 2),
    "gloss_samples": (0.5, 1, 2),
}


def number(word):
    try:
        return int(word)
    except ValueError:
        return float(word)


def study_of(plan, references):
    """A study file, and the plan's own value of each option that has several."""
    lines = [
        "[study]",
        f"scenes = {json.dumps(str(pathlib.Path(plan['scene']).resolve()))}",
        f"width = {plan['size'][0]}\nheight = {plan['size'][1]}\nrepeats = 1\nignore_lamps = true",
        "[reference]",
        f"files = {json.dumps([str(r) for r in references])}",
    ]
    own = {}
    for stage in plan["stages"]:
        tool, words = stage["tool"].removeprefix("phos-"), stage["arguments"]
        lines.append(f"[{tool}]")
        for word, value in zip(words, words[1:]):
            key = word[2:].replace("-", "_")
            if not word.startswith("--") or key in ("width", "height"):
                continue
            if key in LEVELS:
                own[f"{tool}.{word[2:]}"] = number(value)
                near = [factor * number(value) for factor in LEVELS[key]]
                value = sorted({float(f"{v:.4g}") if key == "accuracy" else max(1, round(v)) for v in near})
            elif value.startswith("-"):
                value = True
            elif value.replace(".", "", 1).isdigit():
                value = number(value)
            lines.append(f"{key} = {json.dumps(value)}")
    return "\n".join(lines) + "\n", own


def judge(folder, scene, percent):
    name = pathlib.Path(scene).stem
    plan = json.loads((folder / f"run_{name}_{percent}/plan.json").read_text())
    text, own = study_of(plan, [folder / f"ref_{name}_{seed}.exr" for seed in (1, 2)])
    study, asked = folder / f"best_{name}_{percent}", float(percent) / 100
    study.with_suffix(".toml").write_text(text)
    subprocess.run(["phos-study", study.with_suffix(".toml"), "-o", study, "--pictures", "0", "--quiet", "--discard"], check=True)
    with open(study / "results.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    error = lambda row: float(row["picture_error"] or "inf")
    seconds = lambda row: float(row["picture_seconds"] or "inf")
    [chosen] = [row for row in rows if all(abs(float(row[k]) / v - 1) < 1e-3 for k, v in own.items())]
    best = min((row for row in rows if error(row) <= asked), key=seconds, default=chosen)
    rounds = [r["seconds"] for r in plan["run"]["rounds"]]
    last = seconds(chosen) / seconds(best)
    where = " ".join(f"{k.split('.')[1]} {best[k]}" for k in own)
    print(
        f"{name:28} {percent:>3} %  {len(rows):4}  {error(chosen):7.2%} {seconds(chosen):6.1f} s  {error(best):7.2%}"
        f" {seconds(best):6.1f} s  {last:5.2f} {sum(rounds) / seconds(best):5.2f}  {where}",
        flush=True,
    )


if len(sys.argv) < 4:
    sys.exit(__doc__)
os.environ["PATH"] += os.pathsep + str(pathlib.Path(__file__).resolve().parents[2] / "build/release/bin")
print(f"{'scene':28} asked     n             plan               best   last   all  the best's")
for percent in sys.argv[3:]:
    judge(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], percent)
