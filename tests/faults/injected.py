# SPDX-License-Identifier: LGPL-2.1-or-later
"""A program that is run again and again, each time with one fault, by the library that inject.cc makes."""
import collections
import os
import pathlib
import shutil
import signal
import subprocess

Result = collections.namedtuple("Result", "code out err counted failed operations")


class Program:
    """One command line. It is started once and forks in front of its main() for every run."""

    def __init__(self, library, scratch, *command):
        self.scratch = scratch
        self.process = subprocess.Popen(
            [str(word) for word in command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, bufsize=1,
            env={**os.environ, "LD_PRELOAD": str(library), "TAUT_FAULTS": "1"})

    def run(self, fault="files", n=0, before=None):
        """A run in a folder that is a copy of @p before, or empty."""
        self.folder = self.scratch / "run"
        shutil.rmtree(self.folder, ignore_errors=True)
        if before:
            shutil.copytree(before, self.folder)
        else:
            self.folder.mkdir()
        return self.run_in(self.folder, fault, n)

    def run_in(self, folder, fault="files", n=0):
        self.process.stdin.write(f"{fault} {n} {folder}\n")
        self.process.stdin.flush()
        status, counted, failed = map(int, self.process.stdout.readline().split())
        code = -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status)
        texts = [pathlib.Path(f"{folder}.{ending}").read_text(errors="replace") for ending in ("out", "err", "log")]
        return Result(code, *texts[:2], counted, failed, [line.split(" ", 1) for line in texts[2].splitlines()])

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def ending(code):
    return f"exit code {code}" if code >= 0 else signal.Signals(-code).name


def contents(folder):
    """Bytes of all files below a folder, by their path in it."""
    return {str(file.relative_to(folder)): file.read_bytes() for file in sorted(folder.rglob("*")) if file.is_file()}
