"""How much to prune. Prints:

whole core: 7912 faces, 3 edges of curves
lambda 2.5vox: 733 faces, 7 edges of curves
the default: 939 faces, 103 edges of curves
"""

import matplotlib.pyplot as plt
import nibabel
import voxelcore
from gallery_tools import draw, frame

scan = nibabel.load("thick-and-thin.nii.gz")
whole, pruned = voxelcore.core(scan, lambda_=[0, "2.5vox"])
default = voxelcore.core(scan)
shown = {"whole core": whole, "lambda 2.5vox": pruned, "the default": default}

figure = plt.figure(figsize=(9, 3.4), layout="constrained")
for place, (name, core) in enumerate(shown.items(), 1):
    print(f"{name}: {len(core.face_offsets) - 1} faces, {len(core.free_edges())} edges of curves")
    axes = figure.add_subplot(1, 3, place, projection="3d")
    draw(axes, core, core.radius)
    frame(axes, whole.vertices, turn=20)
    axes.set_title(name, y=0.95)
figure.savefig("gallery-2.png", dpi=80)
