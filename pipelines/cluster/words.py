"""Lines of options: words as in a shell, files of options (@FILE), and the files that words name."""
import os
import shlex

from problem import Problem


def words_of(line, folder, where):
    """The words of a line; files count from `folder` and become absolute. @FILE becomes the options that the file holds, as the programs read it."""
    try:
        words = shlex.split(line)
    except ValueError as error:
        raise Problem(f"{where}: {error}") from None
    found = []
    for word in words:
        found += _options_in(os.path.join(folder, word[1:]), where) if word.startswith("@") and len(word) > 1 else [word]
    return [with_files(word, folder, os.path.realpath) for word in found]


def with_files(word, folder, act):
    """The word with act(path) in place of each file that it names: FILE, NAME=FILE, or several of them with commas between."""

    def replaced(part):
        head, equals, tail = part.rpartition("=")
        path = os.path.join(folder, tail)
        return f"{head}{equals}{act(path)}" if tail and os.path.isfile(path) else None

    parts = word.split(",")
    found = [replaced(part) for part in parts]
    return ",".join(new or part for new, part in zip(found, parts)) if any(found) else replaced(word) or word


def _options_in(path, where):
    """One option a line, as NAME=VALUE or NAME VALUE; # begins a comment."""
    try:
        with open(path, encoding="utf-8") as file:
            lines = [line.partition("#")[0].strip() for line in file]
    except (OSError, UnicodeDecodeError) as error:
        raise Problem(f"{where}: @{path}: {getattr(error, 'strerror', None) or 'is no text'}", 3) from None
    found = []
    for line in filter(None, lines):
        name, *value = line.replace("=", " ", 1).split(None, 1) if "=" in line.split()[0] else line.split(None, 1)
        found.append(name if name.startswith("--") else "--" + name)
        found += [text.lstrip("= \t") for text in value]
    return found
