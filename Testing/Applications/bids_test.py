"""A batch's results as BIDS derivatives: entities of the scans' names are kept, names are as BIDS has them, each table
has its sidecar with every column, files are those of the cases, and cases whose names would be the same are refused.

usage: bids_test.py PROGRAM
"""
import csv
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

# BIDS: entities of letters and digits, then a suffix and an ending.
NAME = re.compile(r"sub-[A-Za-z0-9]+(_[a-z]+-[A-Za-z0-9]+)*_desc-[A-Za-z0-9]+_[A-Za-z0-9]+(\.[a-z]+)+")


def check(condition, message):
    if not condition:
        sys.exit(f"bids_test.py: {message}")


def run(program, *words, code=0):
    done = subprocess.run([program, *map(str, words)], capture_output=True, text=True, check=False)
    check(done.returncode == code, f"{words}: {done.returncode}, {done.stderr}")
    return done.stderr


def check_dataset(bids, raw, starts):
    about = json.loads((bids / "dataset_description.json").read_text())
    check(about["DatasetType"] == "derivative" and about["BIDSVersion"], "no derivative")
    check(about["GeneratedBy"][0]["Name"] == "VoxelCore" and about["GeneratedBy"][0]["Version"], "by whom?")
    check((bids / about["DatasetLinks"]["source"]).resolve() == raw.resolve(), f"source: {about['DatasetLinks']}")
    files = {path for path in bids.rglob("*") if path.is_file() and path.parent != bids}
    seen = set()
    for path in files:
        check(NAME.fullmatch(path.name), f"{path}: no name of BIDS")
        start = path.name.rpartition("_")[0]
        check(str(path.parent.relative_to(bids)) == starts.get(start), f"{path}: in the wrong place, or of no scan")
        seen.add(start)
        if path.suffix != ".json":
            check(path.with_name(path.name.partition(".")[0] + ".json") in files, f"{path}: has no sidecar")
        if path.suffix == ".tsv":
            with open(path, newline="") as stream:
                rows = list(csv.reader(stream, delimiter="\t", quoting=csv.QUOTE_NONE))
            check(all(len(row) == len(rows[0]) and "" not in row for row in rows) and len(rows) > 1, f"{path}: rows")
            told = json.loads(path.with_suffix(".json").read_text())
            check(list(told) == rows[0], f"{path}: its sidecar tells of {list(told)}")
            check(any(one.get("Units") == "mm" for one in told.values()), f"{path}: no units")
    check(seen == set(starts), f"scans: {sorted(seen)}")
    return files


def main(program):
    with tempfile.TemporaryDirectory() as name:
        os.chdir(name)
        raw = Path("raw")
        scans = {
            "sub-01/ses-pre/anat/sub-01_ses-pre_acq-hr_space-MNI_mask.nii.gz":
                "sub-01_ses-pre_acq-hr_space-MNI_desc-voxelcore",
            "sub-01/ses-post/anat/sub-01_ses-post_desc-manual_dseg.nii.gz": "sub-01_ses-post_desc-manual",
            "sub-x2/anat/sub-x2_dseg.nii.gz": "sub-x2_desc-voxelcore",
        }
        starts = {start: str(Path(scan).parent) for scan, start in scans.items()}
        raw.mkdir()
        (raw / "dataset_description.json").write_text("{}")
        for number, scan in enumerate(scans):
            (raw / scan).parent.mkdir(parents=True, exist_ok=True)
            run(program, "phantom", "root", "--size", 16 + number, "--spacing", "1,1,1", "-o", raw / scan)
        for further in ((), ("--units",)):
            run(program, "batch", raw, "-o", "out", "--bids", *further)
            files = check_dataset(Path("out/bids"), raw, starts)
            endings = {path.name.partition("_desc-voxelcore_")[2] for path in files}
            wanted = {"medial.vtp", "skeleton.vtp", "skeleton.swc", "skeletonBranches.tsv", "skeletonSummary.tsv",
                      "report.json"}
            check(wanted <= endings, f"missing: {wanted - endings}")
        whole = {path.read_bytes() for path in Path("out").glob("sub-*/*.vtp")}
        check({path.read_bytes() for path in files if path.suffix == ".vtp"} == whole, "files are not those of cases")
        shutil.rmtree(next(Path("out").glob("sub-x2*")))
        run(program, "batch", "-o", "out", "--gather", "--bids")
        starts.pop("sub-x2_desc-voxelcore")
        check_dataset(Path("out/bids"), raw, starts)
        run(program, "batch", raw, "-o", "maps", "--bids", "--thickness")
        maps = {path.name for path in Path("maps/bids").rglob("*thickness*")}
        check({"sub-x2_desc-voxelcore_thickness.nii.gz", "sub-x2_desc-voxelcore_thickness.json",
               "sub-x2_desc-voxelcore_thicknessHistogram.tsv"} <= maps, f"maps: {maps}")  # fmt: skip
        # Two scans that differ by their suffix alone; and one with a name of its own.
        Path("own").mkdir()
        shutil.copy(raw / "sub-x2/anat/sub-x2_dseg.nii.gz", "own/my scan-3.nii.gz")
        run(program, "batch", "own", "-o", "ours", "--bids")
        found = {str(path.parent.relative_to("ours/bids")) for path in Path("ours/bids").rglob("*.vtp")}
        check(len(found) == 1 and re.fullmatch(r"sub-[A-Za-z0-9]+/anat", found.pop()), f"a name of its own: {found}")
        shutil.copy(raw / "sub-x2/anat/sub-x2_dseg.nii.gz", raw / "sub-x2/anat/sub-x2_mask.nii.gz")
        said = run(program, "batch", raw, "-o", "twice", "--bids", code=3)
        check("rename one scan" in said and not Path("twice").exists(), f"names that are the same: {said}")
        check("leave it out" in run(program, "batch", raw, "-o", "r", "--bids", "--roots", code=2), "roots")
        os.chdir("/")


main(str(Path(sys.argv[1]).resolve()))
