"""What the campaigns share: totals that are kept in a file, so that a campaign stops and goes on, and runs of the
program that are looked at from outside."""

import hashlib
import json
import os
import subprocess
import time


class Totals:
    """Counts of one campaign in a JSON file; `place` says where to go on."""

    def __init__(self, path, name):
        self.path, self.name = path, name
        self.all = {}
        if path and os.path.exists(path):
            with open(path) as file:
                self.all = json.load(file)
        self.of = self.all.setdefault(name, {"runs": 0, "seconds": 0.0, "found": [], "counts": {}, "place": {}})
        self._since = time.monotonic()

    def count(self, what, by=1):
        self.of["counts"][what] = self.of["counts"].get(what, 0) + by

    def ran(self, by=1):
        self.of["runs"] += by

    def found(self, what):
        print("FOUND", self.name, what, flush=True)
        self.of["found"].append(what)

    def place(self, key, value=None):
        if value is not None:
            self.of["place"][key] = value
        return self.of["place"].get(key, 0)

    def save(self):
        now = time.monotonic()
        self.of["seconds"] += now - self._since
        self._since = now
        if not self.path:
            return
        # Another campaign may keep its totals in the same file.
        everything = {}
        if os.path.exists(self.path):
            with open(self.path) as file:
                everything = json.load(file)
        everything[self.name] = self.of
        with open(self.path + ".new", "w") as file:
            json.dump(everything, file, indent=1)
        os.replace(self.path + ".new", self.path)


def run(arguments, environment=None, limit=60, folder=None):
    """Exit code (negative: signal, None: it did not end within `limit` seconds), stdout, stderr, seconds."""
    began = time.monotonic()
    process = subprocess.Popen([str(a) for a in arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               stdin=subprocess.DEVNULL, env=dict(os.environ, **(environment or {})), cwd=folder,
                               start_new_session=True)
    try:
        out, error = process.communicate(timeout=limit)
        code = process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        out, error = process.communicate()
        code = None
    return code, out.decode(errors="replace"), error.decode(errors="replace"), time.monotonic() - began


def digests(folder):
    """SHA-256 of each file under a folder, by its name there."""
    found = {}
    for where, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(where, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = hashlib.sha256(file.read()).hexdigest()
    return found


def checked(arguments, **more):
    """A run that must succeed."""
    code, out, error, _ = run(arguments, **more)
    if code != 0:
        raise SystemExit(f"{' '.join(map(str, arguments))}: exit {code}\n{error}")
    return out
