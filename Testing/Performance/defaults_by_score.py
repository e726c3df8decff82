#!/usr/bin/python3
"""What `core` could do by default, scored: on bodies whose medial axes are known, and on real scans.

usage: defaults_by_score.py BUILD [--data FOLDER] [--repetitions 3] [--rotations 3] [--parts bodies,scans] [--keep FILE]

BUILD has bin/voxelcore, bin/VoxelCoreToleranceEvaluation and bin/VoxelCoreScanScores. Scans are read where they lie:
those of Debian's mricron-data, and those in FOLDER ($VOXELCORE_TEST_DATA); what is not there is named and left out.
Seconds are processor time, the median; the jobs of a repetition follow each other directly. With --keep rows that are
in FILE are not made again.
"""
import argparse
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

TEMPLATES = pathlib.Path("/usr/share/mricron/templates")
SCANS = [  # name, file, options
    ("AAL, 116 regions", TEMPLATES / "aal.nii.gz", []),
    ("JHU white matter, 48", TEMPLATES / "JHU-WhiteMatter-labels-1mm.nii.gz", []),
    ("INIA19, 724", TEMPLATES / "inia19-NeuroMaps.nii.gz", []),
    ("abdominal atlas, 95", "mhalle+spl-abdominal-atlas/seg.nrrd", []),
    ("knee atlas, 49", "mhalle+spl-knee-atlas/seg.nrrd", []),
    ("aorta", "wasserth+TotalSegmentator/aorta.nii.gz", []),
    ("kidneys, 3", "wasserth+TotalSegmentator/T710_renal.nii.gz", []),
    ("chest and spine, 61", "wasserth+TotalSegmentator/example_seg_fast_force_split.nii.gz", []),
    ("skull", "CIBC-Internal+Seg3DData/Skull.nrrd", []),
    ("mouse ventricles", "Gubra-ApS+LSFM-mouse-brain-atlas/gubra_ventricular_mask_olf.nii.gz", []),
]
CANDIDATES = [[*pruning, "--refine", refine] for refine in ("off", "labels")
              for pruning in (["--lambda", "1.5vox"], ["--tolerance", "1diag"], ["--tolerance", "1.2diag"])]


def name_of(candidate):
    return " ".join(candidate[:2]).removeprefix("--") + (", refined" if candidate[-1] == "labels" else "")


def cost(command):
    """Processor seconds and peak memory in MB."""
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL)
    _, status, usage = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"defaults_by_score.py: exit {os.waitstatus_to_exitcode(status)} of {' '.join(map(str, command))}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def rows_of(tools, scan, more, repetitions, folder):
    """For each candidate its numbers as text."""
    costs = [[] for _ in CANDIDATES]
    files = [folder / f"{i}.vtp" for i in range(len(CANDIDATES))]
    for _ in range(repetitions):
        for candidate, file, own in zip(CANDIDATES, files, costs):
            own.append(cost([tools / "voxelcore", "core", scan, *more, *candidate, "-o", file, "--force", "--quiet"]))
    rows = []
    for file, own in zip(files, costs):
        scores = subprocess.run([tools / "VoxelCoreScanScores", scan, file], check=True, text=True,
                                stdout=subprocess.PIPE).stdout.split()
        labels, points, area, rims, seams, ends, lost, gap = map(float, scores)
        seconds, memory = (statistics.median(column) for column in zip(*own))
        rows.append(f"{points:.0f} | {area:.2f} | {rims:.3f} | {seams:.3f} | {ends:.1f} | {lost:.2f} | {gap:.2f} | "
                    f"{seconds:.2f} | {memory:.0f} |")
    return rows


def score_scans(options):
    tools = pathlib.Path(options.build) / "bin"
    kept = pathlib.Path(options.keep) if options.keep else None
    known = kept.read_text().splitlines() if kept and kept.exists() else []
    print("| scan | candidate | boundary vertices | area | rims | seams | ends a label | lost % | gap | s | MB |")
    print("|---" * 11 + "|")
    with tempfile.TemporaryDirectory() as folder:
        for name, path, more in SCANS:
            scan = pathlib.Path(options.data or "") / path
            if not scan.exists():
                print(f"{name}: {path} is not there", file=sys.stderr)
                continue
            rows = [row for row in known if row.startswith(f"| {name} |")]
            if not rows:
                found = rows_of(tools, scan, more, options.repetitions, pathlib.Path(folder))
                rows = [f"| {name} | {name_of(candidate)} | {row}" for candidate, row in zip(CANDIDATES, found)]
                if kept:
                    with kept.open("a") as file:
                        file.write("\n".join(rows) + "\n")
            print("\n".join(rows), flush=True)


def score_bodies(options):
    words = [pathlib.Path(options.build) / "bin/VoxelCoreToleranceEvaluation", "--defaults", "--seeds", "aside",
             "--rotations", str(options.rotations)]
    if options.keep:
        words += ["--keep", options.keep + ".bodies"]
    subprocess.run(words, check=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("--data", default=os.environ.get("VOXELCORE_TEST_DATA"))
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--rotations", type=int, default=3)
    parser.add_argument("--parts", default="bodies,scans")
    parser.add_argument("--keep")
    options = parser.parse_args()
    if "bodies" in options.parts:
        score_bodies(options)
    if "scans" in options.parts:
        score_scans(options)


if __name__ == "__main__":
    main()
