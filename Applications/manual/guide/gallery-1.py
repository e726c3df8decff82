"""A region of a brain atlas. Prints:

<voxelcore.Core of label 37: 1608 vertices, 4474 edges, 2867 faces, tolerance 2.07846 mm>
pieces, loops, cavities: 1 0 0
thickest place: 12.7 mm
"""

import matplotlib.pyplot as plt
import nibabel
import voxelcore
from gallery_tools import draw

atlas = nibabel.load("/usr/share/mricron/templates/aal.nii.gz")
core = voxelcore.core(atlas, label=37)
print(core)
print("pieces, loops, cavities:", *core.topology["betti"])
print(f"thickest place: {2 * core.radius.max():.1f} mm")

figure = plt.figure(figsize=(6, 4), layout="constrained")
axes = figure.add_subplot(projection="3d")
scale = draw(axes, core, core.radius)
figure.colorbar(scale, ax=axes, label="radius, mm", shrink=0.6)
figure.savefig("gallery-1.png", dpi=80)
