"""Plates and rods. Prints:

sheet 0: 22.1 mm^2, 0.52 mm thick
sheet 1: 13.4 mm^2, 0.53 mm thick
sheet 2: 12.9 mm^2, 0.53 mm thick
sheet 3: 12.9 mm^2, 0.62 mm thick
sheet 4: 12.4 mm^2, 0.63 mm thick
rod: 4.3 mm long, 0.73 mm thick
rod: 4.3 mm long, 0.74 mm thick
rod: 4.3 mm long, 0.74 mm thick
rod: 4.2 mm long, 0.75 mm thick
"""

import matplotlib.pyplot as plt
import numpy
import voxelcore
from gallery_tools import draw, frame

i, j, k = numpy.indices((64, 64, 64))
lattice = numpy.zeros((64, 64, 64), bool)
lattice[4:60, 4:60, 6:12] = True  # a floor,
lattice[4:60, 30:35, 6:56] = True  # a wall
for x, y in ((14, 12), (44, 16), (18, 50), (48, 46)):  # and four posts that carry
    lattice |= (numpy.hypot(i - x, j - y) < 4) & (k > 8) & (k < 54)
lattice[4:60, 4:60, 52:57] = True  # a roof
found = voxelcore.sheets(lattice, spacing=(0.1, 0.1, 0.1))
for number, sheet in enumerate(found["sheets"]):
    print(f"sheet {number}: {sheet['area']:.1f} mm^2, {sheet['thickness']:.2f} mm thick")
for curve in found["curves"]:
    if curve["kind"] == "rod":
        print(f"rod: {curve['length']:.1f} mm long, {curve['thickness']:.2f} mm thick")

figure = plt.figure(figsize=(6, 4), layout="constrained")
axes = figure.add_subplot(projection="3d")
draw(axes, found["core"], found["sheet_of_face"], colours="Set2")
frame(axes, found["core"].vertices, turn=-35)
figure.savefig("gallery-6.png", dpi=80)
