"""How the worked examples draw: a core in three dimensions, coloured by a value. Needs matplotlib."""

import matplotlib.pyplot as plt
import numpy
from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection


def frame(axes, points, turn=-60):
    """One scale along x, y and z, around these points."""
    low, high = points.min(axis=0), points.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axes.set_box_aspect(high - low, zoom=1.2)
    axes.view_init(20, turn)
    axes.set_axis_off()


def draw(axes, core, values, colours="viridis", low=None, high=None):
    """Draws a core, coloured by a value at each vertex or face; returns what a colour bar needs."""
    corners, begins = core.face_vertices, core.face_offsets.astype(int)
    if len(values) == len(core.vertices):
        values = numpy.add.reduceat(values[corners], begins[:-1]) / numpy.diff(begins)
    scale = plt.cm.ScalarMappable(plt.Normalize(low, high), colours)
    scale.set_array(values)
    polygons = [core.vertices[corners[a:b]] for a, b in zip(begins, begins[1:])]
    normals = numpy.array([numpy.cross(p[1] - p[0], p[-1] - p[0]) for p in polygons]).reshape(-1, 3)
    paint = scale.to_rgba(values)
    paint[:, :3] *= 0.6 + 0.4 * abs(normals[:, 2:]) / numpy.linalg.norm(normals, axis=1, keepdims=True).clip(1e-12)
    axes.add_collection3d(Poly3DCollection(polygons, facecolors=paint, edgecolors=paint, linewidths=0.3))
    lines = core.vertices[core.edges[core.free_edges()]]
    axes.add_collection3d(Line3DCollection(lines, colors="black", linewidths=1))
    frame(axes, core.vertices)
    return scale
