"""All regions of an atlas. Prints:

48 regions, 169 ml
label 1: 14.7 mm thick, loops: 0
label 5: 12.1 mm thick, loops: 0
label 26: 11.8 mm thick, loops: 0
"""

import matplotlib.pyplot as plt
import nibabel
import numpy
import voxelcore
from gallery_tools import draw, frame

atlas = nibabel.load("/usr/share/mricron/templates/JHU-WhiteMatter-labels-2mm.nii.gz")
cores = voxelcore.core(atlas, label="all")
volume = numpy.array([core.voxels * numpy.prod(core.spacing) / 1000 for core in cores.values()])
thickest = numpy.array([2 * core.radius.max() for core in cores.values()])
print(f"{len(cores)} regions, {volume.sum():.0f} ml")
for label in numpy.array(list(cores))[numpy.argsort(-thickest)[:3]]:
    print(f"label {label}: {2 * cores[label].radius.max():.1f} mm thick, loops: {cores[label].topology['betti'][1]}")

figure = plt.figure(figsize=(9, 3.8), layout="constrained")
axes = figure.add_subplot(1, 2, 1, projection="3d")
for core in cores.values():
    draw(axes, core, core.radius, low=0, high=thickest.max() / 2)
frame(axes, numpy.concatenate([core.vertices for core in cores.values()]))
axes = figure.add_subplot(1, 2, 2)
axes.scatter(volume, thickest)
axes.set(xlabel="volume, ml", ylabel="thickest place, mm", xscale="log")
figure.savefig("gallery-7.png", dpi=80)
