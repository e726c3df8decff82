#!/usr/bin/env python3
"""Files that former versions wrote (formats/VERSION) are read, pruned, measured and rechecked, or refused by name; and
what they hold under a name, today's files hold under it.

usage: formats_test.py VOXELCORE SOURCE_DIR
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

PROGRAM, SOURCE = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
SCANS = {"whole": "box.nrrd", "pruned": "rod-thick-slices.nii.gz", "tolerance": "capsule.mha",
         "refined": "box.nrrd", "branches": "capsule.mha"}  # fmt: skip
# What 0.1 wrote and later versions refuse, with a word on why.
REFUSED = {("0.1.0", "tolerance"): "0.1 pruned it by bumps", ("0.1.0", "branches"): "an older version wrote it"}
# Skeletons of 0.2.0 had the radius of sections under that name, and that of balls as Radius.
GONE = {"0.1.0": {("CellData", "Bump"), ("PointData", "Bump")}, "0.2.0": {("PointData", "SectionRadius")}}


def run(*words, code=0):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == code, f"{words}: exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return done


def arrays(path):
    """{(section, name): (type, components)}"""
    head = path.read_bytes().split(b"<AppendedData")[0].decode()
    found = {}
    sections = r"<(FieldData|PointData|CellData|Points|Verts|Lines|Polys)\b[^>]*>(.*?)</\1>"
    for section, body in re.findall(sections, head, re.S):
        for words in re.findall(r"<(?:Data)?Array ([^>]*)>", body):
            attributes = dict(re.findall(r'(\w+)="([^"]*)"', words))
            kind = "Int" if section in ("Verts", "Lines", "Polys") else attributes["type"]  # 32 bits where they suffice
            found[section, attributes["Name"]] = kind, attributes.get("NumberOfComponents", "1")
    assert len(found) > 8, path
    return found


def keys(value, path=""):
    if isinstance(value, dict):
        return {path + "/" + key for key in value} | {k for key in value for k in keys(value[key], f"{path}/{key}")}
    if isinstance(value, list):
        return {k for item in value for k in keys(item, path + "[]")}
    return set()


def test(version, folder, scratch):
    for name, scan in SCANS.items():
        file = folder / f"{name}.vtp"
        scan = SOURCE / "Data" / scan
        if (version, name) in REFUSED:
            command = ("verify", scan, file) if name != "branches" else ("measure", file, "-o", scratch / "no.csv")
            assert REFUSED[version, name] in run(*command, code=3).stderr
        elif name == "branches":
            run("measure", file, "-o", scratch / "measured.csv", "--force")
            assert len((scratch / "measured_branches.csv").read_text().splitlines()) == 2
        else:
            assert "all passed" in run("verify", scan, file).stdout
            run("render", file, "-o", scratch / "picture.png", "--size", "200x150", "--force")
    # What is made of a former version's whole core is what is made of today's.
    run("core", SOURCE / "Data" / SCANS["whole"], "--lambda", 0, "--keep-edges", "-o", scratch / "whole.vtp",
        "--report", scratch / "whole.json", "--force")  # fmt: skip
    for command, further in (("prune", ("--lambda", "2vox")), ("skeleton", ()), ("sheets", ())):
        made = [scratch / f"{command}-{which}.vtp" for which in ("then", "now")]
        for source, result in zip((folder / "whole.vtp", scratch / "whole.vtp"), made):
            run(command, source, *further, "-o", result, "--force")
        assert made[0].read_bytes() == made[1].read_bytes(), command
    # Names stay.
    run("core", SOURCE / "Data" / SCANS["pruned"], "--lambda", "0.9mm", "-o", scratch / "pruned.vtp", "--force")
    run("core", SOURCE / "Data" / SCANS["tolerance"], "-o", scratch / "tolerance.vtp", "--force")
    run("core", SOURCE / "Data" / SCANS["refined"], "--lambda", "1.5vox", "--refine", "labels", "-o",
        scratch / "refined.vtp", "--force")  # fmt: skip
    run("skeleton", SOURCE / "Data" / SCANS["branches"], "-o", scratch / "branches.vtp", "--force")
    for name in SCANS:
        then, now = arrays(folder / f"{name}.vtp"), arrays(scratch / f"{name}.vtp")
        for place, kind in then.items():
            stays = place in GONE.get(version, ()) or now.get(place) == kind
            assert stays, f"{version}/{name}.vtp: {place} {kind} is gone"
    then, now = (keys(json.loads((place / "whole.json").read_text())) for place in (folder, scratch))
    assert then <= now, f"{version}: reports lack {sorted(then - now)}"


versions = sorted(path for path in (SOURCE / "Testing/Results/formats").iterdir() if path.is_dir())
assert len(versions) >= 2
for one in versions:
    with tempfile.TemporaryDirectory() as scratch:
        test(one.name, one, pathlib.Path(scratch))
    print(f"files of {one.name}: read")
