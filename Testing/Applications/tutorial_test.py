"""The guide's tutorial runs as it stands there, in an empty folder, and ends with the figure and the table on the page.
usage: tutorial_test.py PROGRAM SOURCE_DIR"""

import csv
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path


def check(condition, message):
    if not condition:
        sys.exit("tutorial_test.py: " + message)


def png_size(path):
    return struct.unpack(">II", path.read_bytes()[16:24])


def main():
    program, guide = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve() / "Applications/manual/guide"
    page = (guide / "tutorial.md").read_text()
    commands = re.findall(r"(?m)^    (voxelcore .*)$", page)
    check(len(commands) >= 6, f"commands: {commands}")
    check("scan.nii.gz" in commands[0] and "phantom" in commands[0], "it does not begin with a scan")
    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryDirectory() as binaries:
        os.symlink(program, Path(binaries) / "voxelcore")
        environment = dict(os.environ, PATH=f"{binaries}:{os.environ['PATH']}")
        help_text = subprocess.run([program, "render", "--help"], capture_output=True, text=True).stdout
        drawn = bool(shutil.which("Xvfb")) and "off in this build" not in help_text
        for command in commands:
            if command.startswith("voxelcore render") and not drawn:
                continue
            if not drawn:
                command = re.sub(r" --html \S+", "", command)
            done = subprocess.run(["bash", "-euc", command], cwd=folder, env=environment, capture_output=True,
                                  text=True, stdin=subprocess.DEVNULL)  # fmt: skip
            check(done.returncode == 0, f"{command}\n{done.stderr}")
            check("warning" not in done.stderr.lower(), f"{command}\n{done.stderr}")
        rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in re.findall(r"(?m)^\|.*\|$", page)]
        names, shown = rows[0], rows[2:]
        with open(Path(folder) / "lines_branches.csv", newline="") as stream:
            found = list(csv.DictReader(stream))
        digits = [len(cell.partition(".")[2]) for cell in shown[0]]
        expected = [[f"{float(row[name]):.{places}f}" for name, places in zip(names, digits)] for row in found]
        check(shown == expected, f"the table is {expected}")
        if drawn:
            figure = Path(folder) / "figure.png"
            check(png_size(figure) == png_size(guide / "tutorial.png"), "the figure has another size")
            check(figure.stat().st_size > 0.7 * (guide / "tutorial.png").stat().st_size, "the figure shows less")


main()
