"""Branches of maps of probabilities: lives are those of phantoms whose contrasts are known; probability() finds what
the program finds."""

import csv

import numpy
import pytest
import voxelcore
from conftest import run, write_nrrd

THRESHOLDS = [tenth / 10 for tenth in range(1, 10)]
SEED = 690  # of the first phantom
SHAPE = (84, 84, 96)


def draw(field, begin, end, radius, contrast):
    """A tube whose wall falls off over a voxel and a half, the greater value where it meets another."""
    way = end - begin
    low = numpy.maximum(numpy.floor(numpy.minimum(begin, end) - radius - 3).astype(int), 0)
    high = numpy.minimum(numpy.ceil(numpy.maximum(begin, end) + radius + 4).astype(int), field.shape)
    places = numpy.stack(numpy.meshgrid(*map(numpy.arange, low, high), indexing="ij"), -1) - begin
    share = numpy.clip(places @ way / (way @ way), 0, 1)
    away = numpy.linalg.norm(places - share[..., None] * way, axis=-1)
    part = field[tuple(map(slice, low, high))]
    numpy.maximum(part, contrast * numpy.clip((radius + 0.75 - away) / 1.5, 0, 1), out=part)


def tree(seed):
    """A trunk and branches of random contrasts. Gives the map and, by tube, its end, radius and contrast."""
    random = numpy.random.default_rng(seed)
    field = numpy.zeros(SHAPE)
    foot, head = numpy.array([42.0, 42, 10]), numpy.array([*random.uniform(39, 45, 2), 86])
    tubes = [(foot, head, random.uniform(4, 5.5), random.uniform(0.75, 0.95))]
    turn = random.uniform(0, 7)
    for height in numpy.linspace(0.15, 0.7, int(random.integers(4, 7))):
        turn += random.uniform(1.8, 2.8)
        way = numpy.array([numpy.cos(turn), numpy.sin(turn), random.uniform(0.1, 0.6)])
        base = foot + height * (head - foot)
        length = random.uniform(22, 30)
        tubes.append((base, base + length * way / numpy.linalg.norm(way), random.uniform(2, 3.2),
                      random.uniform(0.15, 0.95)))  # fmt: skip
    for tube in tubes:
        draw(field, *tube)
    return field.astype(numpy.float32), tubes


def life_at(skeleton, lives, begin, end, radius):
    """Of the branch that runs along most of the outer part of a tube; None without one."""
    places = begin + numpy.linspace(0.5, 0.85, 8)[:, None] * (end - begin)
    shares = [
        numpy.mean(numpy.linalg.norm(places[:, None] - skeleton.branch(branch)[None], axis=-1).min(1) <= radius)
        for branch in range(len(skeleton.branch_nodes))
    ]
    return tuple(lives[int(numpy.argmax(shares))]) if max(shares) > 0.25 else None


@pytest.mark.parametrize("seed", range(SEED, SEED + 4))
def test_lives_end_at_the_contrasts_of_a_phantom(tmp_path, seed):
    print("seed", seed)
    field, tubes = tree(seed)
    write_nrrd(tmp_path / "map.nrrd", field, (1, 1, 1))
    done = run("skeleton", "--probability", tmp_path / "map.nrrd", "-o", tmp_path / "sure.vtp", "--also", "csv")
    assert done.returncode == 0, done.stderr
    with open(tmp_path / "sure_branches.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    lives = [(float(row["lowest_threshold"]), float(row["highest_threshold"])) for row in rows]
    skeleton = voxelcore.read(tmp_path / "sure.vtp")
    for begin, end, radius, contrast in tubes:
        reached = [one for one in THRESHOLDS if one <= contrast]
        life = life_at(skeleton, lives, begin, end, radius)
        stable = len(reached) > 2  # a persistence of 0.2 at least
        assert life == ((reached[0], reached[-1]) if stable else None), (contrast, radius)
    made = {path.name for path in tmp_path.glob("sure_threshold-*.vtp")}
    assert made == {f"sure_threshold-{one}.vtp" for one in THRESHOLDS if (field >= numpy.float32(one)).any()}


def test_arrays_give_what_files_give(tmp_path):
    field, _ = tree(SEED)
    thresholds = [0.3, 0.6, 0.97]
    write_nrrd(tmp_path / "map.nrrd", field, (1, 1, 1))
    done = run("skeleton", "--probability", tmp_path / "map.nrrd", "-o", tmp_path / "sure.vtp",
               "--thresholds", "0.3,0.6,0.97", "--persistence", "0.3")  # fmt: skip
    assert done.returncode == 0, done.stderr
    found = voxelcore.probability(field, thresholds, 0.3, spacing=(1, 1, 1))
    assert list(found.trees) == thresholds and found.trees[0.97] is None
    for one in thresholds[:2]:
        saved = voxelcore.read(tmp_path / f"sure_threshold-{one}.vtp")
        assert numpy.array_equal(saved.points, found.trees[one].points)
        assert found.lives[one].shape == (len(saved.branch_nodes), 2)
        assert numpy.array_equal(found.stable[one], found.lives[one] @ [-1, 1] >= 0.3 - 1e-9)
    with open(tmp_path / "sure_thresholds.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["threshold"]) for row in rows if row["chosen"] == "1"] == [found.threshold]
    assert [int(row["stable_branches"]) for row in rows] == [int(found.stable[one].sum()) for one in thresholds]
    whole = numpy.round(field * 255).astype(numpy.uint8)
    turned = voxelcore.probability(whole.T, thresholds, 0.3, axes="kji", spacing=(1, 1, 1))
    assert turned.threshold == found.threshold
    assert all(
        len(turned.trees[one].branch_nodes) == len(found.trees[one].branch_nodes) for one in thresholds[:2]
    )


@pytest.mark.parametrize("array, given, named", [
    (numpy.full((9, 9, 9), 300), {}, "no probabilities"),
    (numpy.full((9, 9, 9), 1.5), {}, "not all whole"),
    (numpy.full((9, 9, 9), -0.5), {}, "no probabilities"),
    (numpy.ones((9, 9, 9)), {"thresholds": [0.5]}, "2 to 100"),
    (numpy.ones((9, 9, 9)), {"thresholds": [0.5, 2]}, "above 0 and up to 1"),
    (numpy.ones((9, 9, 9)), {"persistence": 2}, "a number from 0 to 1"),
    (numpy.ones((9, 9, 9)), {"label": 1}, "label"),
    (numpy.ones((9, 9, 9)), {"thresholds": [0.5, 0.6], "persistence": 0.5}, "less persistence"),
])  # fmt: skip
def test_what_is_no_map_is_refused(array, given, named):
    with pytest.raises(ValueError, match=named):
        voxelcore.probability(array, **given)
