"""Walks every reference of a scene for 3D Slicer and every file it names.
usage: scene_test.py VOXELCORE DUMP_POLYDATA"""
import json
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
import zipfile
from pathlib import Path
from urllib.parse import unquote

from module_test_tools import check, label_at, polydata, run, two_blocks, write_nrrd

PREFIX, SUFFIX = "vtkMRML", "Node"
NAMES = {3: "left block", 8: 'the "other" <block> & more'}
COLORS = {3: (200, 30, 40), 8: (10, 120, 250)}


def near(text, color):
    return all(abs(float(a) - b / 255) < 0.003 for a, b in zip(text.split(), color))


def segments(path):
    """Key/value pairs of a .seg.nrrd by segment number."""
    header = path.read_bytes().split(b"\n\n", 1)[0].decode()
    found = {}
    for line in header.splitlines():
        if line.startswith("Segment") and "_" in line.split(":=")[0] and line[7].isdigit():
            key, value = line.split(":=", 1)
            number, field = key[7:].split("_", 1)
            found.setdefault(int(number), {})[field] = value
    return found


def walk(scene, program, dump, voxels):
    root = xml.parse(scene).getroot()
    check(root.tag == "MRML" and len(root.get("version").split()) == 3 and root.get("version").startswith("Slicer "),
          "version: %s" % root.get("version"))
    nodes = {node.get("id"): node for node in root}
    check(len(nodes) == len(root), "two nodes with one id")
    used_files, referred = set(), set()
    for node in root:
        check(node.get("id").startswith(PREFIX + node.tag + SUFFIX), "%s is no id of a %s" % (node.get("id"), node.tag))
        for reference in filter(None, (node.get("references") or "").split(";")):
            role, target = reference.split(":")
            check(target in nodes, "%s refers to %s, which is not there" % (node.get("id"), target))
            check(nodes[target].tag.endswith({"display": "Display", "storage": "Storage"}[role]), "role " + reference)
            referred.add(target)
        if node.get("fileName"):
            file = scene.parent / unquote(node.get("fileName"))
            check(file.is_file(), "%s is not there" % file)
            used_files.add(file)
    for node in root:
        check((node.get("references") is None) == (node.get("id") in referred), "nobody refers to " + node.get("id"))
    kinds = {kind: [n for n in root if n.tag == kind] for kind in ("Segmentation", "Model", "MarkupsCurve")}
    check(all(kinds.values()), "a kind is missing: %s" % {k: len(v) for k, v in kinds.items()})

    def part(node, role):
        return nodes[[r.split(":")[1] for r in node.get("references").split(";") if r.startswith(role)][0]]

    # models
    ranges, radii = set(), []
    for label, name in NAMES.items():
        model = next(n for n in kinds["Model"] if n.get("name") == name + " medial surface")
        display = part(model, "display")
        check(near(display.get("color"), COLORS[label]), "colour of " + name)
        check(
            display.get("activeScalarName") == "Radius" and display.get("scalarVisibility") == "true"
            and display.get("activeAttributeLocation") == "point" and display.get("backfaceCulling") == "false",
            "scalars")
        check(part(model, "storage").get("coordinateSystem") == "LPS", "space")
        data = polydata(dump, scene.parent / unquote(part(model, "storage").get("fileName")))
        check(data["space"] == "LPS" and "Radius" in data["pointArrays"], "the file of " + name)
        check(display.get("scalarRangeFlag") == "UseManual", "scalarRangeFlag of " + name)
        ranges.add(display.get("scalarRange"))
        radii += data["radii"]
        # Right place: every vertex within the label.
        for point in data["points"]:
            check(label_at(voxels, point) == label, "%s lies outside %s" % (point, name))
    # curves
    of_surfaces = radii
    of_curves = []
    for curve in kinds["MarkupsCurve"]:
        markups = json.loads((scene.parent / unquote(part(curve, "storage").get("fileName"))).read_text())["markups"]
        check(len(markups) == 1 and markups[0]["type"] == "Curve" and markups[0]["coordinateSystem"] == "LPS" and
              markups[0]["coordinateUnits"] == "mm", "markups of " + curve.get("name"))
        points = [p["position"] for p in markups[0]["controlPoints"]]
        radii = markups[0]["measurements"][0]
        check(radii["name"] == "Radius" and len(radii["controlPointValues"]) == len(points) >= 2, "radii")
        of_curves += radii["controlPointValues"]
        label = next(v for v, name in NAMES.items() if curve.get("name").startswith(name))
        check(all(label_at(voxels, p) == label for p in points), "a curve leaves its label")
    # Colours: one range for all, that of most of what is shown, so that the few smallest radii do not take the map.
    check(len(ranges) == 1, "ranges %s" % ranges)
    low, high = (float(x) for x in ranges.pop().split())
    check(
        min(of_surfaces) < low - 1e-3 and low < high <= max(of_surfaces + of_curves) + 1e-6,
        "%s to %s of %s to %s" % (low, high, min(of_surfaces), max(of_surfaces + of_curves)))
    # the segmentation
    file = scene.parent / unquote(part(kinds["Segmentation"][0], "storage").get("fileName"))
    found = {int(s["LabelValue"]): s for s in segments(file).values()}
    check(set(found) == set(NAMES), "segments %s" % set(found))
    for label, segment in found.items():
        check(segment["Name"] == NAMES[label] and near(segment["Color"], COLORS[label]), "segment %s" % segment)
        for key in ("ID", "Layer", "Extent", "Tags"):
            check(key in segment, "segment without " + key)
    info = json.loads(run(program, "info", file, "--json").stdout)
    count = {label["label"]: label["voxels"] for label in info["labels"]}
    check(count == {v: voxels.count(v) for v in NAMES}, "voxels %s" % count)
    return used_files


def main():
    program, dump = sys.argv[1:]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        voxels = two_blocks()
        write_nrrd(folder / "case 01.nrrd", voxels)
        with open(folder / "case 01.txt", "w") as file: # ITK-SNAP's label descriptions
            file.write("# ITK-SnAP Label Description File\n    0     0    0    0        0  0  0    \"Clear Label\"\n")
            for value, title in NAMES.items():
                file.write('%5d %5d %4d %4d        1  1  1    "%s"\n' % (value, *COLORS[value], title))
        run(program, "core", folder / "case 01.nrrd", "--lambda", "1.5vox", "-o", folder / "out.vtp",
            "--with-skeleton", "--scene", folder / "my scene.mrml")
        used = walk(folder / "my scene.mrml", program, dump, voxels)
        check(used == set((folder / "my scene_Data").iterdir()), "files that no node names, or the reverse")
        run(program, "skeleton", folder / "out.vtp", "-o", folder / "again.vtp", "--scene", folder / "again.mrml")

        run(program, "core", folder / "case 01.nrrd", "--lambda", "1.5vox", "-o", folder / "out.vtp",
            "--with-skeleton", "--scene", folder / "box.mrb", "--force")
        with zipfile.ZipFile(folder / "box.mrb") as archive:
            check(archive.testzip() is None, "the archive is damaged")
            names = archive.namelist()
            check(all(n.startswith("box/") and ".." not in n for n in names), "names %s" % names)
            archive.extractall(folder / "unpacked")
        used = walk(folder / "unpacked/box/box.mrml", program, dump, voxels)
        check(len(used) + 1 == len(names), "files that no node names: %s" % names)
        left = {p.name for p in folder.iterdir() if ".part" in p.name or p.name == "Data"}
        check(not left, "left behind: %s" % left)

        before = {p.name for p in folder.iterdir()}
        for arguments, code in ((["--scene", folder / "a.xyz"], 2), (["--scene", folder / "no/a.mrml"], 1),
                                (["--scene", folder / "box.mrb"], 1)):
            result = subprocess.run([program, "core", folder / "case 01.nrrd", "-o", folder / "b.vtp", *arguments],
                                    capture_output=True, text=True)
            check(result.returncode == code and result.stderr.count("\n") == 1, "%s: %s" % (arguments, result))
        check({p.name for p in folder.iterdir()} == before, "a refusal left files behind")


main()
