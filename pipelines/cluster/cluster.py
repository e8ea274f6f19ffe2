#!/usr/bin/env python3
"""Plans, lists and runs the jobs of a configuration on one machine or many; pipelines/cluster.sh calls this program.
  cluster.py check CONFIG                       reads the configuration; prints the number of jobs of each stage
  cluster.py plan CONFIG FOLDER                 writes the command of each job to FOLDER/jobs; prints what is to do
  cluster.py list CONFIG FOLDER [--stage S]     prints the names of the jobs that are to do, earliest first; --ready in place of --stage S: those
                                                whose files to read are there
  cluster.py command FOLDER JOB...              prints the commands of jobs
  cluster.py run FOLDER JOB...                  runs jobs, one after another; one whose file is there is not run
  cluster.py array FOLDER LIST                  runs the job in the line of LIST whose number is $SLURM_ARRAY_TASK_ID
  cluster.py submit CONFIG FOLDER [--wait]      hands what is to do to Slurm, as arrays
  cluster.py probe FOLDER                       asks Slurm whether it answers and its nodes see the folder
  cluster.py publish CONFIG FOLDER              links the results to FOLDER/results
FOLDER is on a file system that all machines mount at the same path. Exit codes are those of the programs: 2 for a wrong configuration, 3 for a file
or a machine.
"""
import os
import shlex
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

import slurm
from configuration import STAGES, Configuration
from folder import Folder, to_do
from jobs import Graph
from problem import Problem, main, nearest
from runner import run_job


def planned(configuration, folder):
    graph, where = Graph(Configuration(configuration)), Folder(folder)
    where.create()
    where.write_jobs(graph)
    return graph, where


def counts(jobs):
    numbers = {}
    for job in jobs:
        numbers[job.stage] = numbers.get(job.stage, 0) + 1
    return ", ".join(f"{count} {stage}" for stage, count in numbers.items()) or "none"


def check(configuration):
    graph = Graph(Configuration(configuration))
    print(f"jobs: {counts(graph.jobs.values())}; results: {len(graph.results)}")


def plan(configuration, folder):
    graph, where = planned(configuration, folder)
    print(f"jobs: {len(graph.jobs)}; to do: {counts(to_do(graph, where))}")


def list_jobs(configuration, folder, *rest):
    graph, where = planned(configuration, folder)
    ready = rest == ("--ready",)
    if rest and not ready and (rest[0] != "--stage" or len(rest) != 2):
        raise Problem(f"list: {rest[0]}: give --stage NAME or --ready")
    if len(rest) == 2 and rest[1] not in STAGES:
        raise Problem(f'--stage {rest[1]}: no such stage{nearest(rest[1], STAGES)}')
    for job in to_do(graph, where):
        if all(where.is_done(need.name) for need in job.needs) if ready else not rest or job.stage == rest[1]:
            print(job.name)


def command(folder, *names):
    for name in names:
        print(shlex.join(Folder(folder).job(name)["command"]))


def run(folder, *names):
    for name in names:
        run_job(Folder(folder), name)


def array(folder, names):
    Folder(folder).token()
    number = os.environ.get("SLURM_ARRAY_TASK_ID", "")
    with open(names, encoding="utf-8") as file:
        lines = file.read().split()
    if not number.isdigit() or not 1 <= int(number) <= len(lines):
        raise Problem(f"{names}: has {len(lines)} jobs, and SLURM_ARRAY_TASK_ID is {number or 'not set'}; sbatch --array=1-{len(lines)} sets it")
    run_job(Folder(folder), lines[int(number) - 1])


def submit(configuration, folder, *rest):
    graph, where = planned(configuration, folder)
    if rest not in ((), ("--wait",)):
        raise Problem(f"submit: {rest[0]}: the only option is --wait")
    jobs, arrays = slurm.submit(graph, where, configuration, bool(rest))
    print(f"submitted: {jobs} jobs in {arrays} arrays")


def probe(folder):
    slurm.check(Folder(folder))


def publish(configuration, folder):
    graph, where = Graph(Configuration(configuration)), Folder(folder)
    print(f"results: {where.publish(graph)} in {where / 'results'}")


COMMANDS = {"check": (check, 1, 1), "plan": (plan, 2, 2), "list": (list_jobs, 2, 4), "command": (command, 2, None), "run": (run, 2, None),
            "array": (array, 2, 2), "submit": (submit, 2, 3), "probe": (probe, 1, 1), "publish": (publish, 2, 2)}


def start():
    words = sys.argv[1:]
    if not words or words[0] in ("-h", "--help"):
        print(__doc__.strip(), file=sys.stdout if words else sys.stderr)
        return 0 if words else 2
    if words[0] not in COMMANDS:
        raise Problem(f'"{words[0]}": no such command{nearest(words[0], list(COMMANDS))}')
    call, least, most = COMMANDS[words[0]]
    if not least <= len(words) - 1 <= (most or len(words)):
        raise Problem(f"{words[0]}: wrong number of words; see cluster.py --help")
    call(*words[1:])
    return 0


if __name__ == "__main__":
    main("cluster.py", start)
