#!/usr/bin/env python3
"""Joins the tables of parts of sensors: the header, which all share, and then the lines of each:  join.py TABLE... [--threads N] [--progress WHICH] -o FILE
The options other than -o are those that every program of a run gets; they change nothing. FILE appears whole or not at all."""
import argparse
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))

from problem import Problem, main


def start():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("tables", nargs="+")
    parser.add_argument("-o", dest="output", required=True)
    parser.add_argument("--threads")
    parser.add_argument("--progress")
    asked = parser.parse_args()
    header, new = None, f"{asked.output}.{os.uname().nodename}-{os.getpid()}.new"
    try:
        with open(new, "wb") as out:
            for path in asked.tables:
                with open(path, "rb") as table:
                    own = table.readline()
                    if header is None:
                        header = own
                        out.write(header)
                    if own != header:
                        raise Problem(f"{path}: has other columns than {asked.tables[0]}", 4)
                    while block := table.read(1 << 20):
                        out.write(block)
        os.replace(new, asked.output)
    except OSError as error:
        raise Problem(f"{error.filename or new}: {error.strerror}", 3) from None
    finally:
        if os.path.exists(new):
            os.remove(new)
    return 0


if __name__ == "__main__":
    main("join.py", start)
