"""Array jobs of Slurm: one array for each level of jobs, which starts where the level before it has ended well (afterok)."""
import os
import shutil
import subprocess
import sys

from folder import to_do, write_whole
from problem import Problem

HERE = os.path.dirname(os.path.realpath(__file__))
INSTALL = "Debian: pipelines/install.sh --cluster, or apt-get install slurm-wlm munge; --profile local needs none"


def ask(*words):
    """What a program of Slurm prints."""
    if shutil.which(words[0]) is None:
        raise Problem(f"{words[0]}: not installed, and --profile slurm and sbatch need Slurm ({INSTALL})", 3)
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        said = (done.stderr or done.stdout).strip().splitlines() or ["it said nothing"]
        raise Problem(f"{words[0]} ended with code {done.returncode}: {said[-1]}", 3)
    return done.stdout


def check(folder):
    """Throws Problem where Slurm does not answer, or a node does not see the folder."""
    if shutil.which("scontrol") is None:
        ask("scontrol")
    answer = subprocess.run(["scontrol", "ping"], capture_output=True, text=True, check=False)
    if " UP" not in answer.stdout:
        said = (answer.stdout.strip() or answer.stderr.strip() or "scontrol ping said nothing").splitlines()[0]
        raise Problem(f"Slurm's controller does not answer ({said}); start slurmctld, or use --profile local or parallel", 3)
    see = "test \"$(cat \"$0\" 2>/dev/null)\" = \"$1\" || { echo unseen by $(hostname -s):$SLURMD_NODENAME; }"
    probe = ["srun", "--quiet", "--immediate=20", "--chdir=/", "--ntasks=1", "--mem=16", "sh", "-c", see, str(folder / ".shared"), folder.token()]
    done = subprocess.run(probe, capture_output=True, text=True, check=False)
    if "unseen by" in done.stdout:
        raise Problem(f"{folder.path}: is not shared: node {done.stdout.strip().rpartition(':')[2]} does not see it; give a folder on a file system "
                      "that all nodes mount at the same path", 3)
    if done.returncode != 0:
        print("cluster.py: warning: no node was free to be asked whether it sees the folder; each job looks for itself", file=sys.stderr)


def submit(graph, folder, configuration_path, wait):
    """Submits what is still to do. Returns the number of jobs and of arrays."""
    waiting = ask("squeue", "--noheader", "--format=%A", f"--name={_name(folder)}").split()
    if waiting:
        raise Problem(f"{folder.path}: job {waiting[0]} of this folder is still in Slurm's queue; wait for it, or: scancel --name={_name(folder)}", 3)
    jobs = to_do(graph, folder)
    most = max(1, int(next((line.split("=")[1] for line in ask("scontrol", "show", "config").splitlines() if line.startswith("MaxArraySize")), "1001")) - 1)
    before, arrays = [], 0
    for level in sorted({job.level for job in jobs}):
        groups = {}
        for job in jobs:
            if job.level == level:
                groups.setdefault(job.stage, []).append(job)
        submitted = []
        for stage, group in groups.items():
            for begin in range(0, len(group), most):
                part = group[begin:begin + most]
                names = folder / f"jobs/array-{level}-{stage}-{begin // most}.txt"
                write_whole(names, "".join(job.name + "\n" for job in part))
                submitted.append(_sbatch(folder, folder.job(part[0].name), before, [f"--array=1-{len(part)}"], ["array", folder.path, names]))
                arrays += 1
        before = submitted
    last = ["--wait"] if wait else []
    _sbatch(folder, {"threads": 1, "memory": 256, "minutes": 30}, before, last, ["publish", os.path.realpath(configuration_path), folder.path])
    return len(jobs), arrays


def _sbatch(folder, needs, before, options, words):
    after = ["--dependency=afterok:" + ":".join(before), "--kill-on-invalid-dep=yes"] if before else []
    words = ["sbatch", "--parsable", f"--job-name={_name(folder)}", "--requeue", "--chdir=/", "--output=/dev/null", *resources(needs), *after, *options,
             os.path.join(HERE, "job.sh"), os.path.join(HERE, "cluster.py"), *words]
    if "--wait" in options:
        subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)  # publish tells afterwards what is missing
        return ""
    return ask(*words).strip().partition(";")[0]


def resources(job):
    return ["--ntasks=1", f"--cpus-per-task={job['threads']}", f"--mem={job['memory']}", f"--time={job['minutes']}"]


def _name(folder):
    return "phos-" + folder.token()
