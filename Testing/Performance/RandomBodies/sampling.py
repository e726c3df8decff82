"""Voxels of a body, wherever it lies on the grid."""
import numpy
from scipy import ndimage


def any_turn(rng):
    """A rotation, every one as likely."""
    q = rng.normal(size=4)
    w, x, y, z = q / numpy.linalg.norm(q)
    return numpy.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])


def turn_about(axis, angle):
    x, y, z = axis
    across = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + numpy.sin(angle) * across + (1 - numpy.cos(angle)) * across @ across


class Placement:
    """Of a body on a grid: place on the grid, mm = turn (place in the body) + shift."""

    def __init__(self, body, spacing, turn, rng):
        self.spacing = numpy.asarray(spacing, float)
        self.turn = turn
        low, high = body.box()
        corners = numpy.array([[(low, high)[k][0], (low, high)[j][1], (low, high)[i][2]]
                               for i in (0, 1) for j in (0, 1) for k in (0, 1)]) @ turn.T
        margin = 3 * self.spacing.max() + 1
        self.shift = margin - corners.min(0) + rng.random(3) * self.spacing
        self.size = numpy.ceil((corners.max(0) - corners.min(0) + 2 * margin) / self.spacing).astype(int) + 1

    def to_grid(self, places):
        return places[:, :3] @ self.turn.T + self.shift

    def to_body(self, places):
        return (places - self.shift) @ self.turn


def distances(body, placement):
    """At voxel centres, which lie at index * spacing; far from lines it is only said that it is far."""
    size, spacing = placement.size, placement.spacing
    if body.distance is not None:
        grid = numpy.stack(numpy.meshgrid(*(numpy.arange(n) * s for n, s in zip(size, spacing)), indexing="ij"), -1)
        return body.distance(placement.to_body(grid)).astype(numpy.float32)
    far = 6.0
    field = numpy.full(size, far, numpy.float32)
    for line in body.lines:
        points = placement.to_grid(line)
        for a, b, ra, rb in zip(points[:-1], points[1:], line[:-1, 3], line[1:, 3]):
            reach = max(ra, rb) + far
            first = numpy.maximum(numpy.floor((numpy.minimum(a, b) - reach) / spacing).astype(int), 0)
            last = numpy.minimum(numpy.ceil((numpy.maximum(a, b) + reach) / spacing).astype(int) + 1, size)
            x, y, z = (((numpy.arange(f, l) * s - o).astype(numpy.float32)) for f, l, s, o in
                       zip(first, last, spacing, a))
            x, y, z = x[:, None, None], y[None, :, None], z[None, None, :]
            way = (b - a).astype(numpy.float32)
            t = numpy.clip((x * way[0] + y * way[1] + z * way[2]) / max(float(way @ way), 1e-9), 0, 1)
            gap = numpy.sqrt((x - t * way[0]) ** 2 + (y - t * way[1]) ** 2 + (z - t * way[2]) ** 2)
            gap -= ra + t * (rb - ra)
            part = tuple(slice(f, l) for f, l in zip(first, last))
            field[part] = numpy.minimum(field[part], gap)
    return field


def voxels(body, placement, rng):
    """Rough surfaces have bumps a few voxels wide; only the largest piece is kept, and cavities are filled."""
    field = distances(body, placement)
    if body.roughness > 0:
        noise = ndimage.gaussian_filter(rng.normal(size=field.shape), 1)
        field = field + body.roughness / noise.std() * noise
    shape = field <= 0
    if body.flips > 0:
        inner = ndimage.binary_erosion(shape)
        outer = ndimage.binary_dilation(shape)
        shape = shape ^ ((outer & ~inner) & (rng.random(shape.shape) < body.flips))
    if body.roughness > 0:
        pieces, _ = ndimage.label(shape)
        shape = pieces == numpy.argmax(numpy.bincount(pieces.ravel())[1:]) + 1
        shape = ndimage.binary_fill_holes(shape)
    return shape
