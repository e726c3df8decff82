"""Vessels: branches and their radii. Prints:

   level  branch_distance  mean_radius  tortuosity
0      1            15.35         1.39        1.02
1      0            18.90         2.24        1.06
2      0            14.63         1.50        1.05
3      0            19.96         3.03        1.02
4      1            17.45         2.06        1.09
5      1            15.47         1.21        1.04
6      2            17.03         1.26        1.05
"""

import matplotlib.pyplot as plt
import numpy
import voxelcore
from gallery_tools import frame

random = numpy.random.default_rng(3)
places = numpy.stack(numpy.indices((72, 64, 100)), axis=-1) * 0.5  # mm
mask = numpy.zeros(places.shape[:3], bool)


def vessel(begin, end, radius, bend):
    along = numpy.linspace(0, 1, 25)[:, None]
    for point in numpy.add(begin, along * numpy.subtract(end, begin)) + numpy.sin(numpy.pi * along) * bend:
        mask[((places - point) ** 2).sum(axis=-1) < (radius * random.uniform(0.92, 1.08)) ** 2] = True


vessel((18, 16, 2), (18, 16, 22), 3.0, (2, 0, 0))  # trunk
vessel((18, 16, 22), (8, 12, 36), 2.2, (0, 3, 0))
vessel((18, 16, 22), (28, 20, 34), 2.0, (0, -3, 0))
vessel((8, 12, 36), (5, 22, 47), 1.4, (0, 0, 2))
vessel((8, 12, 36), (14, 5, 47), 1.5, (-2, 0, 0))
vessel((28, 20, 34), (31, 10, 46), 1.3, (2, 0, 0))
vessel((28, 20, 34), (26, 27, 47), 1.2, (0, 2, 0))

tree = voxelcore.skeleton(mask, spacing=(0.5, 0.5, 0.5), smooth_shape=True, root="bottom")
table = tree.to_pandas()
print(table[["level", "branch_distance", "mean_radius", "tortuosity"]].round(2).to_string())

figure, (left, right) = plt.subplots(1, 2, figsize=(8, 4), layout="constrained")
left.remove()
axes = figure.add_subplot(1, 2, 1, projection="3d")
for number in range(len(table)):
    points = tree.branch(number)
    axes.plot(*points.T, linewidth=3 * table.mean_radius[number], solid_capstyle="round")
frame(axes, tree.points)
right.scatter(table.branch_distance, table.mean_radius, c=[f"C{number % 10}" for number in range(len(table))])
right.set(xlabel="length, mm", ylabel="mean radius, mm", xlim=(0, None), ylim=(0, None))
figure.savefig("gallery-3.png", dpi=80)
