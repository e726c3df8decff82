"""The steps of a computation, each a process: started, watched through its log, stopped. Whoever polls is not kept
waiting, so that Slicer's windows live on, and what is stopped ends at once."""

import json
import os
import shutil
import signal
import subprocess
import tempfile
import time

from . import Cancelled, VoxelCoreError

# How long the steps take, roughly, beside each other.
SHARES = {"core": 1.0, "skeleton": 1.5, "thickness": 3.0}
SUFFIXES = {"core": ".vtp", "skeleton": ".vtp", "thickness": ".nrrd"}


class Step:
    """A command on a volume: what the user is told, and which files come of it."""

    def __init__(self, name, command, volumePath, options, base):
        self.name = name  # of the segment
        self.command = command
        self.volumePath = volumePath
        self.options = options
        self.base = base  # of the files, without suffix

    @property
    def title(self):
        return f"{self.name}: {self.command}"

    def failure(self, line):
        """What the process said, of the segment by its name instead of a file or an array."""
        line = line[len("voxelcore: "):] if line.startswith("voxelcore: ") else line
        about = f"segment {self.name!r}"
        for subject in (self.volumePath, "the array"):
            if line.startswith(subject + ": "):
                return about + line[len(subject):]
        return f"{about}: {line}"

    @property
    def output(self):
        return self.base + SUFFIXES[self.command]

    @property
    def report(self):
        return self.base + ".json"

    @property
    def table(self):
        """Of branches, or of the thickness; of a skeleton's branches the files have the names of --also csv."""
        return self.base + (".csv" if self.command == "thickness" else "_branches.csv")

    @property
    def columns(self):
        return self.base + "_columns.json"

    def arguments(self):
        words = [self.command, self.volumePath, "-o", self.output]
        if self.command == "thickness":
            words += ["--table", self.table]
        else:
            words += ["--report", self.report]
        if self.command == "skeleton":
            words += ["--also", "csv"]
        for name, value in self.options.items():
            words += ["--" + name] + ([] if value is True else [value])
        return words


class Run:
    """Owns a folder for the files, which goes with close()."""

    def __init__(self, backend, temporaryPath=None):
        self.backend = backend
        if temporaryPath:
            os.makedirs(temporaryPath, exist_ok=True)
        self.folder = tempfile.mkdtemp(prefix="VoxelCore-", dir=temporaryPath or None)
        self.steps = []
        self.warnings = []
        self._at = -1
        self._process = None
        self._log = None
        self._read = b""
        self._stepFraction = 0.0
        self._otherLines = []

    @property
    def title(self):
        return self.steps[self._at].title if 0 <= self._at < len(self.steps) else ""

    @property
    def fraction(self):
        shares = [SHARES[step.command] for step in self.steps]
        done = sum(shares[: max(self._at, 0)])
        if 0 <= self._at < len(shares):
            done += shares[self._at] * self._stepFraction
        return min(1.0, done / sum(shares)) if shares else 0.0

    def poll(self):
        """Goes on with what is due. Returns whether all is done. Raises VoxelCoreError when a step failed."""
        if self._process is None:
            if self._at + 1 >= len(self.steps):
                return True
            self._start(self._at + 1)
            return False
        code = self._process.poll()
        self._readLog()
        if code is None:
            return False
        self._process = None
        self._log.close()
        if code != 0:
            step, self._at = self.steps[self._at], len(self.steps)
            last = self._otherLines[-1] if self._otherLines else f"the computation ended with code {code}"
            raise VoxelCoreError(step.failure(last))
        self.warnings += self._otherLines
        if self._at + 1 < len(self.steps):
            self._start(self._at + 1)
            return False
        self._at = len(self.steps)
        return True

    def cancel(self):
        """Ends the process and removes every file."""
        self._end()
        self.close()

    def close(self):
        self._end()
        shutil.rmtree(self.folder, ignore_errors=True)

    def wait(self, onProgress=None):
        """Polls until all is done. onProgress(title, fraction) may return False to stop: Cancelled is raised."""
        while not self.poll():
            if onProgress is not None and onProgress(self.title, self.fraction) is False:
                self.cancel()
                raise Cancelled()
            time.sleep(0.02)

    def _start(self, index):
        self._at = index
        self._stepFraction, self._read, self._otherLines = 0.0, b"", []
        step = self.steps[index]
        words = self.backend.words + step.arguments()
        environment = self.backend.environment
        if self.backend.kind == "program":
            words += ["--progress", "json", "--force"]
        path = os.path.join(self.folder, f"step-{index}.log")
        self._log = open(path, "w+b")
        how = {}
        if os.name == "nt":
            how["creationflags"] = subprocess.CREATE_NO_WINDOW
        else:
            how["start_new_session"] = True
        with open(path, "ab") as log:
            try:
                self._process = subprocess.Popen(
                    words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=log, env=environment, **how
                )
            except OSError as error:
                self._log.close()
                raise VoxelCoreError(f"{words[0]}: {error.strerror}") from None

    def _readLog(self):
        self._read += self._log.read()
        *lines, self._read = self._read.split(b"\n")
        for line in lines:
            text = line.decode("utf-8", "replace").strip()
            if text.startswith("{"):
                try:
                    self._stepFraction = max(self._stepFraction, float(json.loads(text)["fraction"]))
                    continue
                except (ValueError, KeyError, TypeError):
                    pass
            if text:
                self._otherLines.append(text)

    def _end(self):
        process, self._process = self._process, None
        if process is None:
            return
        for how in ("SIGTERM", "SIGKILL"):
            if process.poll() is not None:
                break
            if os.name == "nt":
                process.kill()
            else:
                try:
                    os.killpg(process.pid, getattr(signal, how))
                except ProcessLookupError:
                    pass
            try:
                process.wait(timeout=1.0)
            except subprocess.TimeoutExpired:
                continue
        self._log.close()
        self._at = len(self.steps)
