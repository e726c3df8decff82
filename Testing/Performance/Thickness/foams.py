"""Random foams: walls between Voronoi cells within a ball, and how many walls, seams and junctions there are."""
import itertools

import numpy as np


def half_spaces(points, of):
    """a . x <= b for all that is no farther from point `of` than from any other."""
    others = np.delete(points, of, 0)
    normals = 2 * (others - points[of])
    return normals, (others ** 2).sum(1) - (points[of] ** 2).sum()


def junctions(points, reach):
    """Centres of empty spheres through four points, within a ball."""
    found = []
    for four in itertools.combinations(range(len(points)), 4):
        q = points[list(four)]
        matrix = 2 * (q[1:] - q[0])
        if abs(np.linalg.det(matrix)) < 1e-9:
            continue
        centre = np.linalg.solve(matrix, (q[1:] ** 2).sum(1) - (q[0] ** 2).sum())
        away = np.linalg.norm(points - centre, axis=1)
        if np.linalg.norm(centre) < reach and away.min() > away[four[0]] - 1e-9:
            found.append(centre)
    return found


def seams(points, reach):
    """Per three points the piece of their common line within the ball that no other is nearer to: its length, and the
    least angle of two walls there in degrees."""
    found = []
    for three in itertools.combinations(range(len(points)), 3):
        q = points[list(three)]
        along = np.cross(q[1] - q[0], q[2] - q[0])
        along /= np.linalg.norm(along)
        matrix = np.stack([2 * (q[1] - q[0]), 2 * (q[2] - q[0]), along])
        squares = (q ** 2).sum(1)
        start = np.linalg.solve(matrix, [squares[1] - squares[0], squares[2] - squares[0], 0])
        room = reach ** 2 - start @ start
        if room <= 0:
            continue
        low, high = -np.sqrt(room), np.sqrt(room)
        normals, bounds = half_spaces(points, three[0])
        for a, b in zip(normals @ along, bounds - normals @ start):
            if abs(a) < 1e-9:
                low, high = (low, high) if b > -1e-6 else (1, 0)
            elif a > 0:
                high = min(high, b / a)
            else:
                low = max(low, b / a)
        if high > low:
            sides = [q[1] - q[0], q[2] - q[1], q[0] - q[2]]
            turns = [np.degrees(np.arccos(s @ t / np.linalg.norm(s) / np.linalg.norm(t)))
                     for s, t in zip(sides, sides[1:] + sides[:1])]
            found.append((high - low, min(turns)))
    return found


def walls(points, reach):
    """Per two points the width of their wall within the ball: twice the radius of the largest disc in it."""
    found = []
    for i, j in itertools.combinations(range(len(points)), 2):
        normal = (points[j] - points[i]) / np.linalg.norm(points[j] - points[i])
        middle = (points[i] + points[j]) / 2
        foot = normal * (middle @ normal)
        if reach <= np.linalg.norm(foot):
            continue
        across = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
        across /= np.linalg.norm(across)
        axes = np.stack([across, np.cross(normal, across)])
        radius = np.sqrt(reach ** 2 - foot @ foot)
        normals, bounds = half_spaces(points, i)
        lines, rests = normals @ axes.T, bounds - normals @ foot
        lengths = np.linalg.norm(lines, axis=1)
        real = lengths > 1e-9
        # The disc's room at places of a fine grid; narrow walls are refused anyway.
        u, v = np.meshgrid(*[np.linspace(-radius, radius, 81)] * 2)
        room = radius - np.hypot(u, v)
        for line, rest, length in zip(lines[real], rests[real], lengths[real]):
            room = np.minimum(room, (rest - line[0] * u - line[1] * v) / length)
        if (rests[~real] > -1e-6).all() and room.max() > -0.05 * radius:
            found.append(2 * room.max())
    return found


def random_foam(random, reach, shortest, sharpest, rim):
    """(points, counts): the first with a junction whose seams within the ball are no shorter and whose walls are no
    narrower than `shortest`, in which no two walls meet at less than `sharpest` degrees, and whose counts are those
    within a ball larger by `rim`, too."""
    while True:
        points = (random.random((random.integers(4, 9), 3)) * 2 - 1) * 1.2 * reach
        lines = seams(points, reach)
        if not lines or min(length for length, _ in lines) < shortest or min(turn for _, turn in lines) < sharpest:
            continue
        inside = junctions(points, reach)
        if not inside or len(inside) != len(junctions(points, reach + rim)):
            continue
        sheets = walls(points, reach)
        wider = [len(seams(points, reach + rim)), len(walls(points, reach + rim))]
        if min(sheets) < shortest or wider != [len(lines), len(sheets)]:
            continue
        # Euler: of a ball that is cut into cells, each without holes, this is 1, or something was counted wrongly.
        if cells_within(points, reach) - len(sheets) + len(lines) - len(inside) == 1:
            return points, (len(sheets), len(lines), len(inside))


def cells_within(points, reach):
    u = np.stack(np.meshgrid(*[np.linspace(-reach, reach, 25)] * 3), -1).reshape(-1, 3)
    u = u[(u ** 2).sum(1) < reach ** 2]
    return len(np.unique(((u[:, None] - points) ** 2).sum(2).argmin(1)))
