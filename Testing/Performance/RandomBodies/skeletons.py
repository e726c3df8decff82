"""Curve skeletons by voxelcore and by scikit-image's thinning, in one form, and how far they are from the truth."""
import numpy
from scipy import sparse, spatial
from skimage.morphology import skeletonize_3d


class Curves:
    """points: (n, 3), mm; lines: of indices of points; tips: indices of points; cycles; radius: (n,), mm, or None."""

    def __init__(self, points, lines, tips, length, cycles, radius=None):
        self.points = points
        self.lines = lines
        self.tips = tips
        self.length = length
        self.cycles = cycles
        self.radius = radius


def by_voxelcore(voxelcore, shape, spacing, options):
    skeleton = voxelcore.skeleton(shape.astype(numpy.uint8), spacing=tuple(spacing), threads=1, **options)
    numbers = skeleton.numbers
    tips = numpy.asarray(skeleton.node_points)[numpy.asarray(skeleton.node_kinds) == 0]
    lines = numpy.split(numpy.asarray(skeleton.branch_points), numpy.asarray(skeleton.branch_offsets)[1:-1])
    return Curves(numpy.asarray(skeleton.points), lines, tips, numbers["total_length"],
                  numbers["cycles"], numpy.asarray(skeleton.radius))


def by_thinning(shape, spacing):
    """Voxels are joined to their 26 neighbours, but not where two shorter steps lead to the same one."""
    places = numpy.argwhere(skeletonize_3d(numpy.pad(shape, 1).astype(numpy.uint8)) > 0) - 1
    points = places * spacing
    if len(points) == 0:
        return Curves(numpy.zeros((0, 3)), [], numpy.zeros(0, int), 0.0, 0)
    tree = spatial.cKDTree(places)
    pairs = tree.query_pairs(1.8, output_type="ndarray")
    order = numpy.abs(places[pairs[:, 0]] - places[pairs[:, 1]]).sum(1) if len(pairs) else numpy.zeros(0)
    near = [{} for _ in points]
    for (a, b), steps in zip(pairs, order):
        near[a][b] = near[b][a] = steps
    kept = [(a, b) for (a, b), steps in zip(pairs, order)
            if not any(near[a][c] < steps and near[b].get(c, 9) < steps for c in near[a])]
    degree = numpy.zeros(len(points), int)
    length = 0.0
    for a, b in kept:
        degree[a] += 1
        degree[b] += 1
        length += float(numpy.linalg.norm(points[a] - points[b]))
    graph = sparse.coo_matrix((numpy.ones(len(kept)), numpy.array(kept).T if kept else ([], [])), (len(points),) * 2)
    pieces = sparse.csgraph.connected_components(graph, directed=False)[0]
    return Curves(points, kept, numpy.flatnonzero(degree <= 1), length, len(kept) - len(points) + pieces)


def match_tips(found, true, near):
    """Numbers of true tips that none found is near to, and of found ones near to no true one, each used once."""
    if len(found) == 0 or len(true) == 0:
        return len(true), len(found)
    gaps = numpy.linalg.norm(found[:, None, :] - true[None, :, :], axis=2)
    candidates = sorted((gaps[i, j], i, j) for i, j in numpy.argwhere(gaps <= near[None, :]))
    used, met = set(), set()
    for _, i, j in candidates:
        if i not in used and j not in met:
            used.add(i)
            met.add(j)
    return len(true) - len(met), len(found) - len(used)


def score(body, placement, curves):
    """A dictionary: tips missed and spurious, length off (a part), mean distance from the centre line and, of tubes,
    error of the radius (mm)."""
    voxel = placement.spacing.max()
    true = placement.to_grid(body.tips)
    missed, spurious = match_tips(curves.points[curves.tips], true, body.tips[:, 3] + 3 * voxel)
    low, high = body.length
    off = curves.length - min(max(curves.length, low), high)
    result = {"tips": len(true), "missed": missed, "spurious": spurious, "length": off / high,
              "cycles": int(curves.cycles != body.cycles)}
    lines = numpy.concatenate([placement.to_grid(line) for line in body.lines])
    radii = numpy.concatenate([line[:, 3] for line in body.lines])
    if len(curves.points):
        gaps, nearest = spatial.cKDTree(lines).query(curves.points)
        result["off_axis"] = float(gaps.mean())
        if body.tables_have_radius and curves.radius is not None:
            result["radius"] = float(numpy.median(curves.radius - radii[nearest]))
    return result


def wall_score(voxelcore, body, placement, shape):
    """Error of twice the radius away from the rim (mean and standard deviation), and the part of the sheet that has no
    vertex of the core within two voxels."""
    core = voxelcore.core(shape.astype(numpy.uint8), spacing=tuple(placement.spacing), tolerance="1.2diag",
                          refine="labels", threads=1)
    places = placement.to_body(numpy.asarray(core.vertices))
    rim = body.sheet(places)[1]
    inner = rim > body.thickness
    middle = body.middle[body.sheet(body.middle)[1] > body.thickness]
    if inner.sum() < 10 or len(middle) == 0:
        return None
    error = 2 * numpy.asarray(core.radius)[inner] - body.thickness
    gaps = spatial.cKDTree(places).query(middle)[0]
    reach = 2 * placement.spacing.max()
    return {"thickness": float(error.mean()), "spread": float(error.std()), "lost": float((gaps > reach).mean()),
            "off_sheet": float(body.sheet(places)[0][inner].mean())}
