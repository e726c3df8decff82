"""Writes the roots of a phantom and reads roots.rsml back with a reader of its own: it keeps the rules of RSML 1 (Lobet
et al., Plant Physiology 2015; rootsystemml.github.io/format), and has the numbers of the tables.
usage: rsml_test.py VOXELCORE"""
import csv
import math
import re
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

PO = "{http://www.plantontology.org/xml-dtd/po.dtd}accession"
# What may stand in an element, in this order; "?" at most once, "*" any number, "+" one or more, else exactly once.
RULES = {
    "rsml": ["metadata", "scene"],
    "metadata": ["version", "unit", "resolution", "last-modified", "software", "user", "file-key", "image?",
                 "property-definitions?", "time-sequence?", "function-definitions?"],
    "image": ["name", "captured?", "sha256?"],
    "property-definitions": ["property-definition*"],
    "property-definition": ["label", "type", "default?", "unit?"],
    "function-definitions": ["function-definition*"],
    "function-definition": ["label", "type", "default?", "unit?"],
    "scene": ["properties?", "plant*"],
    "plant": ["properties?", "root*", "annotations?"],
    "root": ["properties?", "geometry", "functions?", "annotations?", "root*"],
    "geometry": ["polyline"],
    "polyline": ["point+"],
    "functions": ["function+"],
    "function": ["sample*"],
}
ATTRIBUTES = {"plant": {"ID", "label"}, "root": {"ID", "label", PO}, "point": {"x", "y", "z"},
              "function": {"name", "domain"}, "sample": {"value"}}


def check(good, what):
    if not good:
        sys.exit("rsml_test.py: " + what)


def validate(element, properties):
    rule = RULES.get(element.tag)
    if element.tag == "properties":
        for child in element:
            check(child.tag in properties, f"property {child.tag} is not defined")
            kind = {"integer": r"-?\d+", "real": r"-?[\d.]+(e[-+]?\d+)?"}[properties[child.tag]]
            check(re.fullmatch(kind, child.text), f"{child.tag} is no {properties[child.tag]}: {child.text}")
        return
    check(set(element.attrib) <= ATTRIBUTES.get(element.tag, set()), f"{element.tag} has {element.attrib}")
    if rule is None:
        check(len(element) == 0, f"{element.tag} has children")
        return
    pattern = "".join(f"(?:{part.rstrip('?*+')} ){part[-1] if part[-1] in '?*+' else ''}" for part in rule)
    tags = "".join(child.tag + " " for child in element)
    check(re.fullmatch(pattern, tags), f"{element.tag} holds {tags[:200]}")
    for child in element:
        validate(child, properties)


def distance(a, b):
    return math.dist(a[:3], b[:3])


def main():
    voxelcore = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder)
        subprocess.run([voxelcore, "phantom", "root", "--size", "96", "--seed", "2", "--laterals", "8", "--contacts",
                        "2", "--grey-values", "--noise-level", "0.05", "-o", path / "a.nrrd", "-q"], check=True)
        subprocess.run([voxelcore, "roots", path / "a.nrrd", "-o", path / "out/", "--no-pictures", "-q"], check=True)
        tree = xml.parse(path / "out/roots.rsml").getroot()
        with open(path / "out/roots.csv", newline="") as file:
            table = list(csv.DictReader(file))
        with open(path / "out/roots.swc") as file:
            points = [[float(word) for word in line.split()] for line in file if not line.startswith("#")]
        graph = xml.parse(path / "out/roots.graphml").getroot()
    check(tree.tag == "rsml", "it begins with " + tree.tag)
    metadata = tree.find("metadata")
    properties = {d.find("label").text: d.find("type").text for d in metadata.iter("property-definition")}
    functions = {d.find("label").text for d in metadata.iter("function-definition")}
    validate(tree, properties)
    check(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d", metadata.find("last-modified").text), "no ISO 8601 time")
    check(metadata.find("unit").text == "mm" and float(metadata.find("resolution").text) == 1, "another unit")
    identifiers = [e.get("ID") for e in tree.iter() if "ID" in e.attrib]
    check(len(identifiers) == len(set(identifiers)), "an ID stands twice")

    seen = 0
    polylines = []

    def visit(root, parent, parent_number, level):
        nonlocal seen
        seen += 1
        number = int(root.get("ID").split("-")[1])
        row = table[number]
        line = [tuple(float(p.get(axis)) for axis in "xyz") for p in root.find("geometry/polyline")]
        polylines.append(line)
        function, = root.find("functions")
        check(function.get("name") in functions and function.get("domain") == "polyline", "an unknown function")
        diameters = [float(sample.get("value")) for sample in function]
        check(len(diameters) == len(line) and min(diameters) > 0, "diameters do not fit the line")
        check(re.fullmatch(r"PO:\d{7}", root.get(PO)), "no plant ontology term")
        check(int(row["level"]) == level == int(root.find("properties/level").text), f"level of {number}")
        check(row["parent"] == ("" if parent_number is None else str(parent_number)), f"parent of {number}")
        check(all(abs(float(row["tip_" + axis]) - at) < 1e-4 for axis, at in zip("xyz", line[-1])), f"tip of {number}")
        first = 0
        if parent is not None:
            node = int(root.find("properties/parent-node").text)
            origin, width = parent[0][node], parent[1][node]
            check(distance(origin, line[0]) < width, f"root {number} does not begin at its parent")
            while first + 2 < len(line) and distance(line[first], origin) < width / 2:
                first += 1
        length = sum(distance(a, b) for a, b in zip(line[first:], line[first + 1:]))
        mean = sum((a + b) / 2 * distance(p, q) for a, b, p, q in
                   zip(diameters[first:], diameters[first + 1:], line[first:], line[first + 1:])) / max(length, 1e-9)
        check(abs(length - float(row["length"])) < 1e-3 * max(1, length), f"length of {number}: {length}")
        check(length == 0 or abs(mean - float(row["mean_diameter"])) < 1e-3 * mean, f"diameter of {number}: {mean}")
        children = root.findall("root")
        check(len(children) == int(row["children"]), f"children of {number}")
        for child in children:
            visit(child, (line, diameters), number, level + 1)

    for plant in tree.iter("plant"):
        for root in plant.findall("root"):
            visit(root, None, None, 0)
    check(seen == len(table) > 10, f"{seen} roots, {len(table)} in the table")
    print(f"RSML holds the {seen} roots of the table.")

    # The same lines, in SWC and GraphML.
    lines = sum(distance(a, b) for line in polylines for a, b in zip(line, line[1:]))
    places = {int(row[0]): [1e-3 * at for at in row[2:5]] for row in points}
    swc = sum(distance(places[int(row[0])], places[int(row[6])]) for row in points if row[6] > 0)
    check(all(row[6] < row[0] for row in points) and sum(row[6] < 0 for row in points) == len(tree.findall(".//plant")),
          "roots.swc is no forest of the plants")
    check(abs(swc - lines) < 0.01 * lines, f"roots.swc is {swc} long, roots.rsml {lines}")
    levels = {int(row[1]) - 5 for row in points}
    check(levels == {int(row["level"]) for row in table}, f"roots.swc has the levels {levels}")
    space = "{http://graphml.graphdrawing.org/xmlns}"
    edges = [{d.get("key"): d.text for d in edge} | edge.attrib for edge in graph.iter(space + "edge")]
    nodes = {node.get("id") for node in graph.iter(space + "node")}
    check(all(edge["source"] in nodes and edge["target"] in nodes for edge in edges), "an edge has no node")
    targets = [edge["target"] for edge in edges]
    check(len(set(targets)) == len(targets) == len(nodes) - len(tree.findall(".//plant")), "GraphML has no forest")
    for number, row in enumerate(table):
        own = [edge for edge in edges if int(edge["root"]) == number]
        check({edge.get("parent", "") for edge in own} == {row["parent"]}, f"GraphML: parent of {number}")
        check({edge["level"] for edge in own} == {row["level"]}, f"GraphML: level of {number}")
    graphml = sum(float(edge["length"]) for edge in edges)
    check(abs(graphml - swc) < 1e-3 * swc, f"roots.graphml is {graphml} long, roots.swc {swc}")
    print(f"So do SWC and GraphML: {len(points)} points, {len(edges)} edges, {swc:.1f} mm.")


main()
