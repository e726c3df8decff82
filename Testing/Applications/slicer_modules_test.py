"""Drives VoxelCore's modules of 3D Slicer the way Slicer does.
usage: slicer_modules_test.py VOXELCORE MODULE_FOLDER DUMP_POLYDATA"""
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml
from pathlib import Path

from module_test_tools import check, label_at, polydata, run, two_blocks, write_nrrd

SIMPLE = ("string", "integer", "double", "float", "boolean", "string-enumeration")


def describe(module):
    """The description, as Slicer asks for it."""
    start = time.monotonic()
    result = subprocess.run([module, "--xml"], capture_output=True, text=True)
    seconds = time.monotonic() - start
    check(result.returncode == 0 and result.stderr == "", "--xml: %s" % result.stderr)
    check(result.stdout.startswith("<?xml"), "--xml does not begin with <?xml")
    check(seconds < 1, "--xml took %.2f s" % seconds)
    return xml.fromstring(result.stdout)


def parameters(description):
    for group in description.findall("parameters"):
        check(group.find("label") is not None and group.find("description") is not None, "a group without a label")
        for child in group:
            if child.tag not in ("label", "description"):
                yield child


def arguments(description, files, changes):
    """Slicer's command line: flags with their values, a boolean's flag only when it is set, then the indexed files."""
    words, indexed = [], {}
    for p in parameters(description):
        name = p.findtext("name")
        check(re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", name), "%s is no name of a variable" % name)
        check(p.findtext("label") and p.find("description") is not None or p.findtext("channel") == "output",
              "%s: no label or description" % name)
        if p.tag in SIMPLE:
            if p.findtext("channel") == "output":
                continue
            value = changes.get(name, p.findtext("default") or "")
            if p.tag == "boolean":
                words += [p.findtext("longflag")] if value == "true" else []
                continue
            if p.tag == "string-enumeration":
                check(value in [e.text for e in p.findall("element")], "%s: its default is no element" % name)
            words += [p.findtext("longflag"), value]
        elif p.findtext("index") is not None:
            indexed[int(p.findtext("index"))] = str(files[p.tag])
        else:
            words += [p.findtext("longflag"), str(files[p.tag])]
    check(sorted(indexed) == list(range(len(indexed))), "indices are not 0, 1, ..")
    return words + [indexed[i] for i in sorted(indexed)]


def run_module(module, words, stop_after=None):
    """Runs it, reading its tags as they come; gives exit code, fractions, and what was on stderr."""
    process = subprocess.Popen([module] + words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    fractions, tags = [], ""
    for line in process.stdout:
        tags += line
        found = re.fullmatch(r"<filter-progress>([0-9.]+)</filter-progress>\n", line)
        if found:
            check(process.poll() is None or stop_after is None, "progress came late")
            fractions.append(float(found.group(1)))
            if stop_after is not None and fractions[-1] >= stop_after:
                process.send_signal(signal.SIGTERM)
                stop_after = None
    error = process.stderr.read()
    return process.wait(), fractions, tags, error


def return_values(path):
    return dict(line.split(" = ") for line in Path(path).read_text().splitlines())


def drive(program, module, command, dump, folder):
    voxels = two_blocks()
    files = {"image": folder / "abc_1.nrrd", "geometry": folder / "abc_2.vtp", "table": folder / "abc_3.csv"}
    write_nrrd(files["image"], voxels)
    description = describe(module)
    help_text = run(program, command, "--help").stdout
    for p in parameters(description):
        flag = p.findtext("longflag")
        check(flag is None or re.search(re.escape(flag) + r"\b", help_text),
              "%s is not in the help of %s" % (flag, command))
    answers = folder / "abc_4.params"
    words = ["--returnparameterfile", str(answers)] + arguments(description, files, {})
    code, fractions, tags, error = run_module(module, words)
    check(code == 0 and error == "", "exit code %d: %s" % (code, error))
    check(len(fractions) >= 3 and fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] == 1,
          "progress: %s" % fractions)
    xml.fromstring("<all>" + tags + "</all>")
    check(tags.startswith("<filter-start>") and tags.rstrip().endswith("</filter-end>"), "tags: " + tags)

    # The result, as VTK reads it: where it belongs, and what the program itself makes.
    data = polydata(dump, files["geometry"])
    check(data["space"] == "LPS" and "Radius" in data["pointArrays"], "no LPS, or no Radius")
    for point, label in zip(data["points"], data["pointLabels"]):
        check(label_at(voxels, point) == label, "%s lies in label %d" % (point, label_at(voxels, point)))
    same, report = folder / "same.vtp", folder / "same.json"
    run(program, command, files["image"], "-o", same, "--report", report, "--quiet")
    check(same.read_bytes() == files["geometry"].read_bytes(), "not what 'voxelcore %s' writes" % command)
    labels = json.loads(report.read_text())["labels"]
    values = return_values(answers)
    betti = [sum(label["shape"]["betti"][d] for label in labels) for d in range(3)]
    check([int(values["b%d" % d]) for d in range(3)] == betti, "Betti numbers %s" % values)
    check(float(values["seconds"]) > 0, "seconds")
    if command == "core":
        check(int(values["faces"]) == sum(label["pruned"][0]["faces"] for label in labels) == data["polys"], "faces")
        area = sum(label["pruned"][0]["area_mm2"] for label in labels)
        check(abs(float(values["area"]) / area - 1) < 1e-6, "area")
    else:
        check(int(values["branches"]) == data["lines"], "branches")
    rows = files["table"].read_text().splitlines()
    check(rows[0].startswith("label,") and len(rows) > 1, "the table: %s" % rows[:1])
    declared = {p.findtext("name") for p in parameters(description) if p.findtext("channel") == "output"}
    check(set(values) <= declared, "values that are not declared: %s" % (set(values) - declared))

    # What a user changes arrives.
    changed = arguments(description, files, {"Labels": "8", "FillCavities": "true"})
    check(run_module(module, changed)[0] == 0, "with other settings")
    check(set(polydata(dump, files["geometry"])["pointLabels"]) == {8}, "Labels = 8")
    code, _, _, error = run_module(module, arguments(description, files, {"Labels": "77"}))
    check(code == 3 and "77" in error and error.count("\n") == 1, "a wrong label: %s" % error)


def cancel(program, module, folder):
    run(program, "phantom", "gyroid", "--size", "128", "-o", folder / "in.nrrd", "--quiet")
    files = {"image": folder / "in.nrrd", "geometry": folder / "out.vtp", "table": folder / "out.csv"}
    words = arguments(describe(module), files, {})
    code, _, _, _ = run_module(module, words, stop_after=0.05)
    check(code not in (0, -signal.SIGTERM), "exit code after SIGTERM: %d" % code)
    check(os.listdir(folder) == ["in.nrrd"], "left behind: %s" % os.listdir(folder))


def main():
    program, modules, dump = sys.argv[1:]
    for name, command in (("VoxelCoreMedialSurface", "core"), ("VoxelCoreCurveSkeleton", "skeleton")):
        module = os.path.join(modules, name)
        with tempfile.TemporaryDirectory() as folder:
            drive(program, module, command, dump, Path(folder))
        with tempfile.TemporaryDirectory() as folder:
            cancel(program, module, Path(folder))


main()
