"""Runs one job of a folder on this machine: nothing where its file is there, else its command, with a look at what it leaves."""
import fcntl
import os
import signal
import subprocess
import sys
import time

from problem import Problem

COLUMNS = "job,host,seconds,cpu_seconds,peak_MB,bytes_read,bytes_written,code,start\n"
SHARE_OF_MERGE = 0.75  # of the memory that a job asked for, for phos-merge --memory


def run_job(folder, name, threads=None):
    """Throws Problem where a needed file is missing, the command fails, or it leaves no file."""
    folder.token()
    if folder.is_done(name):
        return
    job = folder.job(name)
    for need in job["needs"]:
        if not folder.is_done(need):
            raise Problem(f"{name}: needs {need}, which is missing: its job has not run, or failed; see {folder / 'log'}/{need}.log", 3)
    output = folder.store(name)
    target = output + ".partial" if job["folder"] else output
    program = os.path.basename(job["command"][0])
    command = [*job["command"], "--threads", str(threads or job["threads"]), "--progress", "never"]
    if program == "phos-merge" and output.endswith(".photons"):  # the bytes do not depend on it
        command += ["--memory", f"{max(64, int(job['memory'] * SHARE_OF_MERGE))}M"]
    command += ["-o", target]
    if program == "phos-splat" and job["folder"]:
        command[-1] = target + "/%04d.exr"
        command.append("--reuse")  # frames of an interrupted run are kept
    log_path = folder / f"log/{name}.log"
    for path in (target if job["folder"] else os.path.dirname(output), os.path.dirname(log_path)):
        os.makedirs(path, exist_ok=True)
    clock, start = time.time(), time.monotonic()
    code, used = _run(command, log_path, name)
    row = [name, os.environ.get("SLURMD_NODENAME", os.uname().nodename), f"{time.monotonic() - start:.3f}", f"{used.ru_utime + used.ru_stime:.3f}",
           str(used.ru_maxrss // 1024), str(sum(size(folder.store(n)) for n in job["needs"])), str(size(target) if code == 0 else 0), str(code),
           f"{clock:.3f}"]
    _note(folder / "log/jobs.csv", ",".join(row) + "\n")
    if code != 0:
        raise Problem(f"{name}: {program} ended with code {code}: {last_line(log_path)} ({log_path})", code if 0 < code < 126 else 3)
    if not os.path.exists(target) or job["folder"] and not os.listdir(target):
        problem = f"{program} ended with code 0 and without its file {target}"
        with open(log_path, "a", encoding="utf-8") as log:
            log.write(problem + "\n")
        raise Problem(f"{name}: {problem} ({log_path})", 3)
    if job["folder"]:
        os.replace(target, output)


def _run(command, log_path, name):
    """Runs the command; a signal that would end this program is passed on. Returns its code and what it used of the machine."""
    with open(log_path, "a", encoding="utf-8") as log:
        log.write(f"$ {' '.join(command)}\n")
        log.flush()
        try:
            child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log)
        except OSError as error:
            raise Problem(f"{name}: {command[0]}: {error.strerror} on {os.uname().nodename}; programs need the same path on all machines", 3) from None
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            signal.signal(number, lambda got, _: child.send_signal(got))
        _, status, used = os.wait4(child.pid, 0)
        code = child.returncode = os.waitstatus_to_exitcode(status)
    return (code if code >= 0 else 128 - code), used


def size(path):
    if not os.path.isdir(path):
        return os.path.getsize(path) if os.path.exists(path) else 0
    return sum(os.path.getsize(os.path.join(at, name)) for at, _, names in os.walk(path) for name in names)


def last_line(path):
    with open(path, encoding="utf-8", errors="replace") as file:
        lines = [line.strip() for line in file if line.strip()]
    return lines[-1] if lines and not lines[-1].startswith("$ ") else "it said nothing"


def _note(path, line):
    """Appends a line; several machines append to one file."""
    try:
        with open(path, "a", encoding="utf-8") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            if os.fstat(file.fileno()).st_size == 0:
                line = COLUMNS + line
            file.write(line)
    except OSError as error:  # of a full disk: the job itself matters more
        print(f"cluster.py: warning: {path}: {error.strerror}", file=sys.stderr)
