"""What `roots` found, against roots that are known: polylines with levels and radii."""
import json
import re
import xml.etree.ElementTree as Xml

import numpy
from scipy.spatial import cKDTree


class Roots:
    """Polylines with a level each. `lines`: points (n x 3); `radii`: of them; `parents`: -1 for a stem."""

    def __init__(self):
        self.lines, self.radii, self.levels, self.parents = [], [], [], []

    def add(self, line, radii, level, parent=-1):
        self.lines.append(numpy.asarray(line, float))
        self.radii.append(numpy.asarray(radii, float))
        self.levels.append(level)
        self.parents.append(parent)
        return len(self.lines) - 1

    def samples(self):
        """Middle of each step, its length, its level, its radius, its line."""
        middle, length, level, radius, number = [], [], [], [], []
        for which, line in enumerate(self.lines):
            middle.append((line[1:] + line[:-1]) / 2)
            length.append(numpy.linalg.norm(line[1:] - line[:-1], axis=1))
            radius.append((self.radii[which][1:] + self.radii[which][:-1]) / 2)
            level.append(numpy.full(len(line) - 1, self.levels[which]))
            number.append(numpy.full(len(line) - 1, which))
        return [numpy.concatenate(one) for one in (middle, length, level, radius, number)]

    def length(self):
        return float(sum(numpy.linalg.norm(line[1:] - line[:-1], axis=1).sum() for line in self.lines))


def read_rsml(path):
    """The roots of an RSML file of ours, and whether each ends at a contact is not known there."""
    roots = Roots()

    def visit(element, level, parent):
        points = [[float(point.get(axis)) for axis in "xyz"] for point in element.findall("geometry/polyline/point")]
        diameters = [float(sample.get("value", sample.text)) for function in element.findall("functions/function")
                     if function.get("name") == "diameter" for sample in function.findall("sample")]
        number = roots.add(points, numpy.array(diameters) / 2, level, parent)
        for child in element.findall("root"):
            visit(child, level + 1, number)
    for root in Xml.parse(path).getroot().iter("plant"):
        for stem in root.findall("root"):
            visit(stem, 0, -1)
    return roots


def outside_parents(roots):
    """The same roots from their parent's surface on, where those of RSML begin on its axis."""
    outside = Roots()
    for line, radii, level, parent in zip(roots.lines, roots.radii, roots.levels, roots.parents):
        if parent >= 0:
            there, at = cKDTree(roots.lines[parent]).query(line)
            within = there < roots.radii[parent][at]
            first = int(numpy.argmin(within)) if not within.all() else len(line) - 2
            line, radii = line[first:], radii[first:]
        outside.add(line, radii, level, parent)
    return outside


def read_published(path):
    """A hierarchical skeleton: vertices with level and radius, edges (ASCII PLY). Gives lines of a step each, tips, the
    graph's length. Roots that spring from the stem come in two levels there, of which the first is what lies between
    the stem's axis and where single roots begin: to us both are level 1."""
    with open(path, encoding="ascii") as file:
        names = []
        for line in file:
            found = re.match(r"element (vertex|edge) (\d+)", line)
            if found:
                vertices, edges = (int(found[2]), 0) if found[1] == "vertex" else (vertices, int(found[2]))
            elif line.startswith("property") and not edges_begun(names, line):
                names.append(line.split()[-1])
            elif line.startswith("end_header"):
                break
        table = numpy.array([file.readline().split() for _ in range(vertices)], float)
        ends = numpy.array([file.readline().split() for _ in range(edges)], int)
    column = {name: table[:, at] for at, name in enumerate(names)}
    places = numpy.stack([column["x"], column["y"], column["z"]], 1)
    level = column["level"].astype(int)
    return places, numpy.where(level > 1, level - 1, level), column["radius"], ends


def edges_begun(names, line):
    return "radius" in names and line.split()[-1] in ("vertex1", "vertex2", "vertex_indices")


def share(part, whole):
    return 100 * float(part) / float(whole) if whole > 0 else float("nan")


def compare(found, truth_points, truth_level, truth_length, truth_radius, truth_tips, tip_radius, reach=3.0):
    """Figures of a result. A tip is found within `reach` and its radius. A stretch of the truth has its level if a root
    of that level is as near as the nearest one, within a voxel; it is missed where none is within `reach` and its
    radius."""
    middle, length, level, _, _ = found.samples()
    tree = cKDTree(middle)
    nearest, _ = tree.query(truth_points)
    right = numpy.zeros(len(truth_points), bool)
    for one in numpy.unique(level):
        of = level == one
        there, _ = cKDTree(middle[of]).query(truth_points)
        right |= (truth_level == one) & (there <= nearest + 1) & (there <= truth_radius + reach)
    ends = []
    for which, line in enumerate(found.lines):
        ends.append(line[-1])
        if found.parents[which] < 0:
            ends.append(line[0])
    ends = numpy.array(ends)
    away, _ = cKDTree(ends).query(truth_tips)
    back, at = cKDTree(truth_tips).query(ends)
    return {"tips found %": share((away <= tip_radius + reach).sum(), len(truth_tips)),
            "spurious %": share((back > tip_radius[at] + reach).sum(), len(ends)),
            "covered %": share(truth_length[nearest <= truth_radius + reach].sum(), truth_length.sum()),
            "length %": 100 * length.sum() / truth_length.sum(),
            "level %": share(truth_length[right].sum(), truth_length.sum()),
            "roots": len(found.lines), "levels": int(max(found.levels)) + 1}


def stem_path(found, truth_line, truth_radius):
    """The share of the true stem that the found one runs along within its radius, and of the found one that does."""
    stem = numpy.concatenate([line for line, level in zip(found.lines, found.levels) if level == 0])
    there, _ = cKDTree(dense(stem)).query(truth_line)
    back, at = cKDTree(truth_line).query(dense(stem))
    return share((there <= truth_radius).sum(), len(truth_line)), share((back <= truth_radius[at]).sum(), len(back))


def dense(line, step=0.5):
    """A polyline with points no farther apart."""
    points = [line[:1]]
    for a, b in zip(line, line[1:]):
        count = max(1, int(numpy.ceil(numpy.linalg.norm(b - a) / step)))
        points.append(a + (b - a) * (numpy.arange(1, count + 1) / count)[:, None])
    return numpy.concatenate(points)


def balance(folder):
    """What report.json says of the skeleton's length: that of roots, what is left out, and the part accounted for."""
    with open(f"{folder}/report.json", encoding="utf-8") as file:
        return json.load(file)["roots"].get("balance")
