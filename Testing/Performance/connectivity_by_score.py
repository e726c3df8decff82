#!/usr/bin/env python3
"""Which voxels hang together by default: masks read by 6, by 26, and with pieces that touch joined.

    /usr/bin/python3 Testing/Performance/connectivity_by_score.py build SCAN...

Prints a row for each scan: its voxels; pieces/loops/cavities of its labels, summed, each way; and how many voxels
change for that. `build` has bin/voxelcore.
"""

import json
import pathlib
import subprocess
import sys
import tempfile


def score(program, scan, way):
    """Voxels, pieces/loops/cavities, and voxels changed; None where it is refused."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "r.json"
        run = subprocess.run(
            [program, "skeleton", scan, "--connectivity", way, "--cavities", "keep", "--border", "closed", "--quiet",
             "-o", f"{folder}/", "--report", report],
            stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        if run.returncode == 3 and "too rough" in run.stderr:
            return None
        if run.returncode != 0:
            raise RuntimeError(run.stderr)
        labels = json.loads(report.read_text())["labels"]
    edits = [label.get("edits", {}) for label in labels]
    made = [edit.get("connected", edit.get("touching", {})) for edit in edits]
    added, removed = (sum(one.get(f"voxels_{what}", 0) for one in made) for what in ("added", "removed"))
    numbers = (sum(numbers) for numbers in zip(*(label["shape"]["betti"] for label in labels)))
    voxels = sum(label["voxels"] for label in labels) - added + removed
    return voxels, "/".join(map(str, numbers)), added + removed


def main():
    program = pathlib.Path(sys.argv[1]) / "bin/voxelcore"
    print("| mask | voxels | 6 | 26 | changed | joined | changed |")
    print("|---|---|---|---|---|---|---|")
    for scan in sys.argv[2:]:
        voxels, six, _ = score(program, scan, "6")
        rest = [score(program, scan, way) or (0, "refused", "") for way in ("26", "joined")]
        row = [pathlib.Path(scan).name.split(".")[0], voxels, six, *(word for one in rest for word in one[1:])]
        print(f"| {' | '.join(map(str, row))} |", flush=True)


if __name__ == "__main__":
    main()
