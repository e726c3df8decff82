"""The guide's table of arrays and columns is complete: commands run on small phantoms, every array of their .vtp files
and every column of their tables has its row, and every row its array or column. What columns mean is what the program
writes beside the tables. usage: arrays_test.py PROGRAM SOURCE_DIR [--record]   writes the tables of columns anew"""

import csv
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

COMMANDS = """
phantom vessels --size 48 --spacing 1,1,1 -o vessels.nrrd
phantom root --size 32 --spacing 1,1,1 -o plant.nrrd
phantom thick-and-thin --size 24 --spacing 1,1,1 -o body.nrrd
core body.nrrd --split-components -o core.vtp --table table.csv
core body.nrrd --tolerance 0 --keep-edges -o whole.vtp
skeleton vessels.nrrd --network --sections 4vox --flow flow.csv --centerlines centerlines.vtp --also csv -o net.vtp
skeleton plant.nrrd --probability --thresholds 0.3,0.5 --also csv -o sure.vtp
skeleton plant.nrrd --edits edits.csv --also csv -o named.vtp
straighten vessels.nrrd net.vtp --branch 0 -o tube.nrrd --table straight.csv --points points.csv --mapped mapped.csv
roots plant.nrrd --no-pictures -o roots/
thickness body.nrrd -o map.nrrd --table thickness.csv --surface surface.vtp --medial medial.vtp
sheets body.nrrd -o sheets.vtp --table sheets.csv
core cube.ply --resolution 4,8 -o study.vtp
batch body.nrrd -o cohort/
"""

# Which files hold the arrays that the page names by kind.
KINDS = {"medial": ["core.vtp", "whole.vtp", "medial.vtp"], "skeleton": ["net.vtp", "sure.vtp", "named.vtp"],
         "sheets": ["sheets.vtp"], "surface": ["surface.vtp"], "sections": ["net_sections.vtp"],
         "centerlines": ["centerlines.vtp"]}  # fmt: skip

# Tables by the headings of the page: the file, and where it is told what its columns mean.
TABLES = {
    "OUT_branches.csv": ("net_branches.csv", "net_columns.json", "branches"),
    "OUT_summary.csv": ("net_summary.csv", "net_columns.json", "summary"),
    "OUT_contacts.csv": ("net_contacts.csv", "net_columns.json", "contacts"),
    "OUT_sections.csv": ("net_sections.csv", "net_columns.json", "sections"),
    "OUT_lesions.csv": ("net_lesions.csv", "net_columns.json", "lesions"),
    "--flow OUT.csv": ("flow.csv", "flow_columns.json", "segments"),
    "OUT_nodes.csv": ("flow_nodes.csv", "flow_columns.json", "nodes"),
    "straighten --table": ("straight.csv", "straight_columns.json", "planes"),
    "straighten --mapped": ("mapped.csv", "mapped_columns.json", "points"),
    "roots.csv": ("roots/roots.csv", "roots/columns.json", "roots"),
    "levels.csv": ("roots/levels.csv", "roots/columns.json", "levels"),
    "plant.csv": ("roots/plant.csv", "roots/columns.json", "plant"),
    "profile.csv": ("roots/profile.csv", "roots/columns.json", "profile"),
    "annotations.csv": ("roots/annotations.csv", "roots/columns.json", "annotations"),
    "thickness --table": ("thickness.csv", "thickness_columns.json", "thickness"),
    "OUT_histogram.csv": ("thickness_histogram.csv", "thickness_columns.json", "histogram"),
    "sheets --table": ("sheets.csv", "sheets_columns.json", "sheets"),
    "OUT_seams.csv": ("sheets_seams.csv", "sheets_columns.json", "seams"),
}
# Their columns are the keys of reports, as the page says.
OF_REPORTS = {"cohort/cases.csv": ("cohort/columns.json", "cases"),
              "cohort/labels.csv": ("cohort/columns.json", "labels")}
# Told of by their columns file alone.
PLAIN = {"sure_branches.csv": ("sure_columns.json", "branches"), "sure_summary.csv": ("sure_columns.json", "summary"),
         "sure_thresholds.csv": ("sure_thresholds_columns.json", "thresholds"),
         "named_branches.csv": ("named_columns.json", "branches"),
         "named_summary.csv": ("named_columns.json", "summary"),
         "named_annotations.csv": ("named_annotations_columns.json", "annotations"),
         "table.csv": ("table_columns.json", "labels"), "study.csv": ("study_columns.json", "resolutions")}
# Written by this test; copies of what other commands write.
INPUTS = {"edits.csv", "points.csv"}
FIRST = ("label", "name", "part")  # told once for all tables


def check(condition, message):
    if not condition:
        sys.exit("arrays_test.py: " + message)


def run_commands(program, *further):
    Path("points.csv").write_text("x,y,z\n20,20,20\n")
    Path("edits.csv").write_text("branch,x,y,z,name\n,16,16,16,stem\n")
    corners = [(c % 2, c // 2 % 2, c // 4) for c in range(8)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    faces = [f"4 {a} {b} {c} {d}" for a, b, c, d in sides]
    Path("cube.ply").write_text(
        "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 6\nproperty list uchar int vertex_indices\nend_header\n"
        + "\n".join([f"{x} {y} {z}" for x, y, z in corners] + faces) + "\n")  # fmt: skip
    for command in COMMANDS.strip().splitlines():
        has_tables = not command.startswith("phantom")
        done = subprocess.run([program, *command.split(), "-q", *(further if has_tables else ())],
                              capture_output=True, text=True)
        check(done.returncode == 0, f"voxelcore {command}\n{done.stderr}")


def arrays_of(path):
    """{(section, name)} of a .vtp file."""
    head = path.read_bytes().partition(b"<AppendedData")[0].decode("latin-1")
    found = set()
    for section in ("PointData", "CellData", "FieldData"):
        for body in re.findall(rf"<{section}[^>]*>(.*?)</{section}>", head, re.S):
            found |= {(section, name) for name in re.findall(r'<(?:Data)?Array [^>]*?Name="(\w+)"', body)}
    return found


def grouped(columns):
    """[(name or names with their unit, meaning)], x, y and z in one row."""
    rows = []
    names = list(columns)
    while names:
        name = names.pop(0)
        told = columns[name]
        shown = f"`{name}`"
        if name.endswith("x") and names[:2] == [name[:-1] + "y", name[:-1] + "z"]:
            shown = "`x`, `y`, `z`" if name == "x" else f"`{name}`, `_y`, `_z`"
            del names[:2]
        unit = told.get("Units", "1")
        rows.append((shown + (f" {unit}" if unit != "1" else ""), told["Description"]))
    return rows


def table_text(columns):
    first = {name: columns[name] for name in FIRST if name in columns}
    kept = {name: told for name, told in columns.items() if name not in first or "given" in told["Description"]}
    return "column | meaning\n---|---\n" + "".join(" | ".join(row) + "\n" for row in grouped(kept))


def named(cell):
    """Names of the columns in the first cell of a row."""
    names = re.findall(r"`(\w+)`", cell)
    return [names[0][:-2] + name if name in ("_y", "_z") else name for name in names]


def flat_keys(value, prefix, found):
    """Paths to the values of a report, joined by `_`."""
    for key, inner in enumerate(value) if isinstance(value, list) else value.items():
        name = f"{prefix}_{key}" if prefix else str(key)
        found.add(name)
        if isinstance(inner, (dict, list)):
            flat_keys(inner, name, found)
    return found


def check_arrays(page):
    told = {}  # (kind, section, name)
    for section, heading in (("PointData", "At points"), ("CellData", "At cells"), ("FieldData", "Fields")):
        table = re.search(rf"(?m)^### {heading}\n\n.*\n---.*\n((?:`.*\n)+)", page)
        check(table, f"arrays.md has no table '{heading}'")
        for row in table[1].splitlines():
            names, kinds, meaning = row.split(" | ")
            check(meaning.strip(), f"arrays.md does not say what {names} mean")
            for name in re.findall(r"`(\w+)`", names):
                for kind in KINDS if kinds == "all" else kinds.split(", "):
                    check(kind in KINDS, f"arrays.md: what kind of file is '{kind}'?")
                    check((kind, section, name) not in told, f"arrays.md says twice what {name} is at {kind}")
                    told[kind, section, name] = meaning
    found = {(kind, *array) for kind, files in KINDS.items() for file in files for array in arrays_of(Path(file))}
    check(len(found) > 60, f"only {len(found)} arrays were found")
    check(found <= told.keys(), f"arrays.md lacks these arrays: {sorted(found - told.keys())}")
    check(told.keys() <= found, f"arrays.md has arrays that nothing writes: {sorted(told.keys() - found)}")
    others = {str(path) for path in Path().rglob("*.vtp")} - {file for files in KINDS.values() for file in files}
    for path in sorted(others):  # those of other commands are of the same kinds
        check(any(arrays_of(Path(path)) <= {key[1:] for key in told if key[0] == kind} for kind in KINDS), path)


def columns_of(file, key):
    columns = json.loads(Path(file).read_text())[key]
    check(all(told["Description"] or name[-1] in "yz" for name, told in columns.items()),
          f"{file} does not say what all columns of {key} mean")  # fmt: skip
    return columns


def check_units(program):
    """With --units the first line of every table has the units that its columns file gives, and what reads tables
    reads these."""
    run_commands(program, "--units")
    tables = {file: (columns_file, key) for file, columns_file, key in TABLES.values()} | OF_REPORTS | PLAIN
    named_units = 0
    for file, (columns_file, key) in tables.items():
        with open(file, newline="") as stream:
            written = next(csv.reader(stream))
        units = {name: told.get("Units", "1") for name, told in columns_of(columns_file, key).items()}
        expected = [name + (f" [{unit}]" if unit != "1" else "") for name, unit in units.items()]
        check(written == expected, f"{file} with --units begins with {written}, not {expected}")
        named_units += sum(unit != "1" for unit in units.values())
    check(named_units > 100, f"only {named_units} columns have units")
    for again in ("roots plant.nrrd --no-pictures --edits roots/annotations.csv -o edited/",
                  "straighten vessels.nrrd net.vtp --branch 0 -o 2.nrrd --points straight.csv --mapped mapped2.csv"):
        done = subprocess.run([program, *again.split(), "-q"], capture_output=True, text=True)
        check(done.returncode == 0, f"voxelcore {again}\n{done.stderr}")
    points = [Path(name).read_text().count("\n") for name in ("straight.csv", "mapped2.csv")]
    check(points[0] == points[1] > 10, "points of a table with units are not all mapped")


def check_columns(page, record):
    headings = re.findall(r"(?m)^### `([^`]+)`$", page)
    check(sorted(headings) == sorted(TABLES), f"tables of arrays.md: {sorted(set(headings) ^ set(TABLES))}")
    for heading, (file, columns_file, key) in TABLES.items():
        with open(file, newline="") as stream:
            written = next(csv.reader(stream))
        place = re.search(rf"(?m)^### `{re.escape(heading)}`\n\n(column \|.*\n---.*\n(?:`.*\n)*)", page)
        check(place, f"arrays.md has no table of {heading}")
        columns = columns_of(columns_file, key)
        check(list(columns) == written, f"{columns_file} explains {list(columns)}, but {file} has {written}")
        if record:
            page = page[:place.start(1)] + table_text(columns) + page[place.end(1):]
        else:
            same = place[1] == table_text(columns)
            check(same, f"arrays.md tells of {heading} other than {columns_file}; run this test with --record")
        rows = [row.split(" | ")[0] for row in place[1].splitlines()[2:]]
        if not record:
            names = [name for row in rows for name in named(row)]
            check([name for name in written if name not in FIRST or name in names] == names,
                  f"arrays.md: columns of {heading} are {written}, not {names}")  # fmt: skip
    files = {str(path) for path in Path().rglob("*.csv")}
    known = {file for file, _, _ in TABLES.values()} | set(OF_REPORTS) | set(PLAIN) | INPUTS
    heads = {tuple(open(file).readline().strip().split(",")) for file in known - set(OF_REPORTS)}
    for file in sorted(files - known):
        check(tuple(open(file).readline().strip().split(",")) in heads, f"arrays.md does not know the table {file}")
    report = flat_keys(json.loads(next(Path("cohort").glob("sub-*/*_report.json")).read_text()), "", set())
    labels = {name.removeprefix("labels_0_") for name in report}
    own = set(re.findall(r"`(\w+)`", re.search(r"(?m)^### `cases\.csv`.*\n\n((?:.+\n)+)", page + "\n")[1]))
    for file in OF_REPORTS:
        unknown = set(open(file).readline().strip().split(",")) - report - labels - own
        check(not unknown, f"{file}: arrays.md does not say where these columns are from: {sorted(unknown)}")
    return page


def main():
    program = str(Path(sys.argv[1]).resolve())
    path = Path(sys.argv[2]).resolve() / "Applications/manual/guide/arrays.md"
    record = sys.argv[3:] == ["--record"]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        run_commands(program)
        page = check_columns(path.read_text(), record)
        if record:
            path.write_text(page)
        check_arrays(page)
        # Something missing, and something too much, is noticed.
        for change in (("`ErosionThickness`", "`Erosion`"), ("`Strahler`", "`Strahler`, `Length2`")):
            try:
                check_arrays(page.replace(*change))
            except SystemExit as fault:
                check("arrays.md" in str(fault), str(fault))
            else:
                check(False, f"{change} is not noticed")
        Path("units").mkdir()
        os.chdir("units")
        check_units(program)
        os.chdir("/")


main()
