#!/usr/bin/python3
"""Skeletons and sheets of bodies drawn at random, against the lines and sheets they were made of; one page of results.

usage: evaluate.py BUILD -o FOLDER [--seed N] [--bodies N] [--families NAME,..]

BUILD is the build folder, with the Python module in it. Each family is drawn anew from a fresh seed, which is printed,
and lies anywhere on the grid, in any direction, in cubic voxels and in slices twice and three times as thick.
scikit-image's thinning runs on the same voxels. FOLDER gets results.json, and README.md with tables and pictures.
Needs python3-numpy, python3-scipy, python3-skimage and python3-matplotlib.
"""
import argparse
import json
import os
import secrets
import sys

import numpy

import bodies
import sampling
import skeletons

THICKNESSES = (1, 1, 2, 3)  # of slices; bodies whose truth is less than two of them wide are not drawn


def draw(family, seed, number):
    rng = numpy.random.default_rng([seed, list(bodies.FAMILIES).index(family), number])
    body = bodies.FAMILIES[family](rng)
    thin = min((line[:, 3].min() for line in body.lines), default=body.thickness or 9)
    spacing = numpy.array([1.0, 1.0, rng.choice([t for t in THICKNESSES if t == 1 or thin >= 1.2 * t])])
    placement = sampling.Placement(body, spacing, sampling.any_turn(rng), rng)
    return body, placement, sampling.voxels(body, placement, rng)


def run_family(voxelcore, family, seed, count):
    rows = []
    for number in range(count):
        body, placement, shape = draw(family, seed, number)
        row = {"number": number, "body": body.parameters, "slices": float(placement.spacing[2])}
        if body.thickness is not None:
            score = skeletons.wall_score(voxelcore, body, placement, shape)
            if score is None:
                continue
            rows.append(row | {"voxelcore": score})
            continue
        curves = skeletons.by_voxelcore(voxelcore, shape, placement.spacing, body.options)
        thinned = skeletons.by_thinning(shape, placement.spacing)
        rows.append(row | {"voxelcore": skeletons.score(body, placement, curves),
                           "thinning": skeletons.score(body, placement, thinned)})
    return rows


def run_turns(voxelcore, seed, count):
    """The same tree or fork at 1, 1.5 and 2 times the resolution, turned by 0, 17, 33 and 45 degrees."""
    rows = []
    for number in range(count):
        rng = numpy.random.default_rng([seed, 1000, number])
        body = bodies.FAMILIES[("trees", "forks")[number % 2]](rng)
        axis = bodies.direction(rng)
        tips, lengths = {"voxelcore": [], "thinning": []}, {"voxelcore": [], "thinning": []}
        for resolution in (1.0, 1.5, 2.0):
            for degrees in (0, 17, 33, 45):
                spacing = numpy.ones(3) / resolution
                placement = sampling.Placement(body, spacing, sampling.turn_about(axis, numpy.radians(degrees)), rng)
                shape = sampling.voxels(body, placement, rng)
                for way, curves in (("voxelcore", skeletons.by_voxelcore(voxelcore, shape, spacing, {})),
                                    ("thinning", skeletons.by_thinning(shape, spacing))):
                    if curves.cycles == body.cycles:  # voxels may close a slit between two arms here and there
                        tips[way].append(len(curves.tips))
                        lengths[way].append(curves.length)
        row = {"body": f"{body.family}, {body.parameters}", "tips": len(body.tips)}
        for way in (way for way in tips if tips[way]):
            row[way] = {"same": float(numpy.mean(numpy.array(tips[way]) == len(body.tips))),
                        "variation": float(numpy.std(lengths[way]) / numpy.mean(lengths[way]))}
        rows.append(row)
    return rows


def run_ranges(voxelcore, seed, count):
    """Plates along planes of the grid, whose labels do not tell how thick they are."""
    rows = []
    for normal, step in (((1, 0, 0), 1.0), ((1, 1, 0), 2 ** -0.5), ((1, 1, 1), 3 ** -0.5)):
        errors = []
        for number in range(count):
            rng = numpy.random.default_rng([seed, 2000, number])
            body = bodies.flat_wall(rng, rng.uniform(4, 12))
            n = numpy.array(normal, float) / numpy.linalg.norm(normal)
            turn = numpy.stack([*bodies.frame(n), n], 1)
            placement = sampling.Placement(body, numpy.ones(3), turn, rng)
            score = skeletons.wall_score(voxelcore, body, placement, sampling.voxels(body, placement, rng))
            errors.append(score["thickness"])
        rows.append({"normal": normal, "allowed": step, "least": min(errors), "most": max(errors)})
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--seed", type=int, default=secrets.randbelow(10 ** 9))
    parser.add_argument("--bodies", type=int, default=24)
    parser.add_argument("--families", default=",".join(bodies.FAMILIES))
    arguments = parser.parse_args()
    sys.path.insert(0, os.path.join(arguments.build, "python"))
    import voxelcore
    import page
    os.makedirs(arguments.output, exist_ok=True)
    print("seed", arguments.seed, flush=True)
    results = {"seed": arguments.seed, "bodies": arguments.bodies, "version": voxelcore.__version__, "families": {}}
    for family in arguments.families.split(","):
        results["families"][family] = run_family(voxelcore, family, arguments.seed, arguments.bodies)
        print(page.family_line(family, results["families"][family]), flush=True)
    if arguments.families == parser.get_default("families"):
        results["turns"] = run_turns(voxelcore, arguments.seed, max(2, arguments.bodies // 4))
        results["plates"] = run_ranges(voxelcore, arguments.seed, max(4, arguments.bodies // 2))
    with open(os.path.join(arguments.output, "results.json"), "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)
    page.write(voxelcore, results, draw, arguments.output)


if __name__ == "__main__":
    main()
