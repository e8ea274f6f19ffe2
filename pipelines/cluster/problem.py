"""Errors that end a program with one line, and the nearest of some names."""
import difflib
import sys


class Problem(Exception):
    """One line that says what is wrong and how to mend it, and the exit code (2: command line or configuration, 3: a file or a machine)."""

    def __init__(self, text, code=2):
        super().__init__(text)
        self.code = code


def nearest(word, known):
    """'; did you mean "NAME"?' for the nearest known name, or the list of known names."""
    found = difflib.get_close_matches(str(word), known, 1, 0.5)
    return f'; did you mean "{found[0]}"?' if found else "; known: " + ", ".join(known)


def main(program, run):
    """Runs `run`; a Problem becomes a line on standard error and its code."""
    try:
        sys.exit(run())
    except Problem as problem:
        print(f"{program}: {problem}", file=sys.stderr)
        sys.exit(problem.code)
    except BrokenPipeError:  # of a reader like head
        sys.stderr.close()
        sys.exit(0)
