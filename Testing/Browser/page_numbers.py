#!/usr/bin/env python3
"""Every number on a cohort's page and in its tables stands in a report: read by other means than those that wrote them.

usage: page_numbers.py OUTDIR         what `voxelcore batch` made
       page_numbers.py --make PROGRAM DATA    makes a small cohort of the scans in DATA first
"""
import csv
import hashlib
import json
import os
import re
import subprocess
import sys
import tempfile

# Where the numbers of a column stand in a label's part of the report.
PLACES = {
    "volume mm³": ("volume_mm3",),
    "area mm²": ("pruned", 0, "area_mm2"),
    "max radius mm": ("core", "max_radius_mm"),
    "pieces": ("shape", "betti", 0),
    "loops": ("shape", "betti", 1),
    "cavities": ("shape", "betti", 2),
    "branches": ("skeleton", "branches"),
    "tips": ("skeleton", "tips"),
    "junctions": ("skeleton", "junctions"),
    "length mm": ("skeleton", "total_length_mm"),
    "mean radius mm": ("skeleton", "mean_radius_mm"),
}


def load(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def at(value, place):
    for step in place:
        try:
            value = value[step]
        except (KeyError, IndexError, TypeError):
            return None
    return value


def flat(value, name=""):
    """Names and values of all numbers and texts in a piece of JSON, as columns have them."""
    if isinstance(value, (dict, list)):
        for key, part in value.items() if isinstance(value, dict) else enumerate(value):
            yield from flat(part, f"{name}_{key}" if name else str(key))
    else:
        yield name, value


def table(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def check_page(out, data):
    numbers = 0
    assert set(data["columns"]) == set(PLACES), data["columns"]
    for case in data["cases"]:
        record = load(f"{out}/{case['folder']}/{case['folder']}_case.json")
        assert case["done"] == (record["status"] == "done") and case["reason"] == record["reason"], case["id"]
        assert case["warnings"] == record["warnings"] and case["id"] == record["id"], case["id"]
        for output in record["outputs"]:
            with open(f"{out}/{case['folder']}/{output['name']}", "rb") as file:
                assert hashlib.sha256(file.read()).hexdigest() == output["sha256"], output["name"]
        shown = {name for _, name in case["files"]} | {case["thumbnail"], case["view"]} - {""}
        assert shown == {output["name"] for output in record["outputs"]}, shown
        labels = load(f"{out}/{case['folder']}/{case['folder']}_report.json")["labels"] if case["done"] else []
        assert [label["label"] for label in case["labels"]] == [label["label"] for label in labels], case["id"]
        for shown, label in zip(case["labels"], labels):
            assert shown["certificate"] is label["certificate"]["passed"] is True, (case["id"], shown)
            assert shown["name"].startswith(label["name"])
            for title, value in zip(data["columns"], shown["values"]):
                assert value == at(label, PLACES[title]), (case["id"], label["label"], title, value)
                numbers += value is not None
    return numbers


def check_tables(out, data):
    numbers = 0
    labels = iter(table(f"{out}/labels.csv"))
    for row in table(f"{out}/cases.csv"):
        record = load(f"{out}/{row['folder']}/{row['folder']}_case.json")
        assert row["status"] == record["status"], row
        if record["status"] != "done":
            continue
        for label in load(f"{out}/{row['folder']}/{row['folder']}_report.json")["labels"]:
            line = next(labels)
            assert line["folder"] == row["folder"]
            for name, value in flat(label):
                if name.startswith("skeleton_cuts") or value is None:
                    continue
                cell = line[name]
                if isinstance(value, bool):
                    assert cell == str(value).lower(), (row["folder"], name)
                elif isinstance(value, (int, float)):
                    assert float(cell) == value, (row["folder"], name, cell, value)
                    numbers += 1
                else:
                    assert cell.lstrip("'") == value.lstrip("'"), (row["folder"], name, cell, value)
    assert next(labels, None) is None, "labels.csv has lines of no case"
    assert len(table(f"{out}/cases.csv")) == len(data["cases"])
    return numbers


def check(out):
    with open(f"{out}/index.html", encoding="utf-8") as file:
        page = file.read()
    data = json.loads(re.search(r'<script id="data" type="application/json">(.*?)</script>', page, re.S).group(1))
    on_page = check_page(out, data)
    in_tables = check_tables(out, data)
    failed = [case["id"] for case in data["cases"] if not case["done"]]
    labels = sum(len(case["labels"]) for case in data["cases"])
    print(
        f"{len(data['cases'])} cases, {len(failed)} failed, {labels} labels: {on_page} numbers on the page and "
        f"{in_tables} in labels.csv are those of the reports")
    return on_page, failed


def main():
    if sys.argv[1] != "--make":
        check(sys.argv[1])
        return
    program, scans = sys.argv[2:]
    with tempfile.TemporaryDirectory() as work:
        with open(f"{work}/bad.nrrd", "w", encoding="utf-8") as file:
            file.write("no scan")
        chosen = [os.path.join(scans, name) for name in ("ball-40.nii.gz", "box.nrrd", "plate-3.nrrd", "torus.nrrd")]
        made = subprocess.run([program, "batch", *chosen, f"{work}/bad.nrrd", "-o", f"{work}/out"],
                              capture_output=True,
                              text=True,
                              check=False)
        assert made.returncode == 1, made.stderr
        on_page, failed = check(f"{work}/out")
        assert failed == ["bad"] and on_page >= 40, (failed, on_page)


if __name__ == "__main__":
    main()
