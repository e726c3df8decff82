"""Tables, sentences and pictures of an evaluation."""
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot
import numpy

import skeletons

HEADER = ("| family | bodies | true tips | missed | spurious | other cycles | length off %: mean, worst | off axis | "
          "radius off: mean, worst |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |")


def total(rows, way, key):
    return sum(row[way].get(key, 0) for row in rows)


def figures(rows, way):
    """Of one way over a family; lengths in %, of those whose cycles are the body's, the rest in mm, that is in sides of
    the finest voxels."""
    lengths = numpy.array([100 * row[way]["length"] for row in rows if not row[way]["cycles"]] or [numpy.nan])
    axes = [row[way]["off_axis"] for row in rows if "off_axis" in row[way]]
    radii = [row[way]["radius"] for row in rows if "radius" in row[way]]
    return {"missed": total(rows, way, "missed"), "spurious": total(rows, way, "spurious"),
            "cycles": total(rows, way, "cycles"), "length": float(lengths.mean()),
            "worst": float(lengths[numpy.argmax(numpy.abs(lengths))]), "axis": float(numpy.mean(axes)),
            "radius": (float(numpy.mean(radii)), float(max(radii, key=abs))) if radii else None}


def family_line(family, rows):
    if rows and "thickness" in rows[0]["voxelcore"]:
        score = {key: numpy.array([row["voxelcore"][key] for row in rows]) for key in rows[0]["voxelcore"]}
        worst = score["thickness"][numpy.argmax(numpy.abs(score["thickness"]))]
        return (f"| {family} | {len(rows)} | {score['thickness'].mean():+.2f} | {worst:+.2f} | "
                f"{score['spread'].mean():.2f} | {100 * score['lost'].mean():.2f} | {score['off_sheet'].mean():.2f} |")
    own, other = figures(rows, "voxelcore"), figures(rows, "thinning")
    cells = [family, str(len(rows)), str(total(rows, "voxelcore", "tips"))]
    cells += [f"{own[key]} ({other[key]})" for key in ("missed", "spurious", "cycles")]
    cells.append(" ".join(text % ("none" if numpy.isnan(of["length"]) else f"{of['length']:+.1f}, {of['worst']:+.1f}")
                          for of, text in ((own, "%s"), (other, "(%s)"))))
    cells.append(f"{own['axis']:.2f} ({other['axis']:.2f})")
    cells.append(f"{own['radius'][0]:+.2f}, {own['radius'][1]:+.2f}" if own["radius"] else "")
    return "| " + " | ".join(cells) + " |"


def sentences(families):
    """What a README may say."""
    curves = [row for rows in families.values() for row in rows if "thinning" in row]
    true = total(curves, "voxelcore", "tips")
    lines = []
    if curves:
        own, other = figures(curves, "voxelcore"), figures(curves, "thinning")
        lines.append(f"Of {true} branch tips of {len(curves)} random bodies, voxelcore missed {own['missed']} and "
                     f"found {own['spurious']} that are none; scikit-image's thinning {other['missed']} and "
                     f"{other['spurious']}.")
        lines.append(f"Curves lie {own['axis']:.2f} of a voxel off the true line in the mean ({other['axis']:.2f} by "
                     "thinning).")
    walls = [row["voxelcore"] for row in families.get("walls", [])]
    if walls:
        lines.append(f"Twice the radius of a refined sheet is the wall's thickness within "
                     f"{numpy.mean([abs(row['thickness']) for row in walls]):.2f} of a voxel in the mean.")
    return lines


def worst_of(rows):
    return max(rows, key=lambda row: (row["voxelcore"]["missed"] + row["voxelcore"]["spurious"],
                                      abs(row["voxelcore"]["length"])))


def picture(voxelcore, draw, family, seed, row, path):
    """The body seen along its shortest side, with both skeletons over it."""
    body, placement, shape = draw(family, seed, row["number"])
    curves = skeletons.by_voxelcore(voxelcore, shape, placement.spacing, body.options)
    thinned = skeletons.by_thinning(shape, placement.spacing)
    depth = int(numpy.argmin(shape.shape * placement.spacing))
    across = [axis for axis in range(3) if axis != depth]
    extent = [side for axis in across for side in (-0.5 * placement.spacing[axis],
                                                    (shape.shape[axis] - 0.5) * placement.spacing[axis])]
    figure, panels = matplotlib.pyplot.subplots(1, 2, figsize=(9, 4.5), dpi=80)
    for panel, found, name in zip(panels, (curves, thinned), ("voxelcore", "thinning")):
        panel.imshow(shape.sum(depth).T, cmap="Greys", origin="lower", extent=extent, vmax=1.6 * shape.sum(depth).max())
        for line in found.lines:
            panel.plot(*found.points[list(line)][:, across].T, "-", color="tab:blue", linewidth=1)
            panel.plot(*found.points[found.tips][:, across].T, "o", color="tab:red", markersize=4)
        true = placement.to_grid(body.tips)
        panel.plot(*true[:, across].T, "+", color="tab:green", markersize=9)
        score = row["voxelcore" if found is curves else "thinning"]
        panel.set_title(f"{name}: {score['missed']} missed, {score['spurious']} spurious", fontsize=9)
        panel.set_axis_off()
    figure.suptitle(f"{family}: {row['body']}", fontsize=9)
    figure.tight_layout()
    figure.savefig(path)
    matplotlib.pyplot.close(figure)


def write(voxelcore, results, draw, folder):
    families = results["families"]
    text = ["# Random bodies", "",
            f"Seed {results['seed']}, voxelcore {results['version']}. In brackets: scikit-image's thinning.",
            "Lengths are in sides of the finest voxels. `length off` is of bodies whose cycles are found as they are:",
            "noise, and slits between arms, close others in the voxels. Flipped voxels are a quarter of those at the",
            "boundary; voxelcore mends them first, with the options that its message names, and thinning has none.", "",
            *sentences(families), "", HEADER]
    text += [family_line(name, rows) for name, rows in families.items() if rows and "thinning" in rows[0]]
    text += ["", "| refined from labels | bodies | thickness off: mean | worst | spread | lost % | off sheet |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    text += [family_line(name, rows) for name, rows in families.items() if rows and "thinning" not in rows[0]]
    if "plates" in results:
        text += ["", "| plates along a plane of the grid | thickness off | what labels leave open |",
                 "| --- | --- | --- |"]
        text += [f"| {tuple(row['normal'])} | {row['least']:+.2f} to {row['most']:+.2f} | +- {row['allowed']:.2f} |"
                 for row in results["plates"]]
    if "turns" in results:
        text += ["", "| three resolutions, four turns | tips as true % | length varies by %: mean, worst |",
                 "| --- | --- | --- |"]
        for way in ("voxelcore", "thinning"):
            rows = [row[way] for row in results["turns"] if way in row]
            same = [100 * row["same"] for row in rows]
            varies = [100 * row["variation"] for row in rows]
            text.append(f"| {way} | {numpy.mean(same):.1f} | {numpy.mean(varies):.2f}, {max(varies):.2f} |")
    text += ["", "## The worst of each family", "", "Green crosses are true tips, red points those found.", ""]
    for name, rows in families.items():
        if rows and "thinning" in rows[0]:
            file = name.replace(" ", "-") + ".png"
            picture(voxelcore, draw, name, results["seed"], worst_of(rows), os.path.join(folder, file))
            text += [f"![{name}]({file})", ""]
    with open(os.path.join(folder, "README.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(text).rstrip() + "\n")
