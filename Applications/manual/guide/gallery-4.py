"""Roots: a graph. Prints:

25 tips, the farthest 13.4 mm along the root
level 0: 9 branches, 12.0 mm
level 1: 23 branches, 23.2 mm
level 2: 15 branches, 13.9 mm
"""

import matplotlib.pyplot as plt
import networkx
import nibabel
import voxelcore
from gallery_tools import frame
from mpl_toolkits.mplot3d.art3d import Line3DCollection

root = voxelcore.skeleton(nibabel.load("plant.nii.gz"), root="top")
graph = root.to_networkx()
tips = [node for node, kind in graph.nodes(data="kind") if kind == "tip"]
top = max(tips, key=lambda node: graph.nodes[node]["pos"][2])
way = networkx.single_source_dijkstra_path_length(graph, top, weight="branch_distance")
print(f"{len(tips)} tips, the farthest {max(way.values()):.1f} mm along the root")

table = root.measure()
for level in range(int(table["level"].max()) + 1):
    lengths = table["branch_distance"][table["level"] == level]
    print(f"level {level}: {len(lengths)} branches, {lengths.sum():.1f} mm")

figure = plt.figure(figsize=(6, 5), layout="constrained")
axes = figure.add_subplot(projection="3d")
lines = Line3DCollection([data["points"] for *_, data in graph.edges(data=True)], cmap="plasma", linewidths=3)
lines.set_array([min(way[a], way[b]) for a, b in graph.edges()])
axes.add_collection3d(lines)
frame(axes, root.points)
figure.colorbar(lines, ax=axes, label="mm from the top", shrink=0.6)
figure.savefig("gallery-4.png", dpi=80)
