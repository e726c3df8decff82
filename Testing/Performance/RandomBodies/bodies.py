"""Bodies whose centre lines or middle sheets are known, drawn at random from families.

Lengths are in units of the finest voxel's side at resolution 1. A body is a union of balls along lines, each point with
its radius, or a function of places; both give the signed distance to the surface, negative inside.
"""
import numpy


class Body:
    """lines: (n, 4) arrays of points along centre lines, x, y, z and the radius. tips: (n, 4), where skeletons end.

    length: a range, as the lines of arms that overlap are no lines of the body. sheet: of a wall, a function from
    places to their distance from its middle and from its rim, and samples of its middle; thickness: of a wall.
    """

    def __init__(self, family, parameters):
        self.family = family
        self.parameters = parameters
        self.lines = []
        self.tips = numpy.zeros((0, 4))
        self.length = None
        self.distance = None
        self.reach = None
        self.cycles = 0
        self.sheet = None
        self.middle = None
        self.thickness = None
        self.roughness = 0.0
        self.flips = 0.0
        self.options = {}
        self.tables_have_radius = False

    def along(self, *lines, tips, length=None):
        """A union of balls."""
        self.lines = [numpy.asarray(line, float) for line in lines]
        self.tips = numpy.asarray(tips, float).reshape(-1, 4)
        whole = sum(line_length(line) for line in self.lines)
        self.length = (whole, whole) if length is None else length
        return self

    def box(self):
        if self.reach is not None:
            return -numpy.asarray(self.reach), numpy.asarray(self.reach)
        points = numpy.concatenate(self.lines)
        return (points[:, :3] - points[:, 3:]).min(0), (points[:, :3] + points[:, 3:]).max(0)


def line_length(line):
    return float(numpy.linalg.norm(numpy.diff(line[:, :3], axis=0), axis=1).sum())


def direction(rng):
    v = rng.normal(size=3)
    return v / numpy.linalg.norm(v)


def frame(n):
    """Two unit vectors across n."""
    across = numpy.cross(n, numpy.eye(3)[numpy.argmin(numpy.abs(n))])
    across /= numpy.linalg.norm(across)
    return across, numpy.cross(n, across)


def straight(a, b, ra, rb=None):
    a, b = numpy.asarray(a, float), numpy.asarray(b, float)
    steps = max(2, int(numpy.linalg.norm(b - a)) + 1)
    t = numpy.linspace(0, 1, steps)[:, None]
    return numpy.hstack([a + t * (b - a), ra + t * ((ra if rb is None else rb) - ra)])


def log_uniform(rng, low, high):
    return float(numpy.exp(rng.uniform(numpy.log(low), numpy.log(high))))


def tube(rng):
    radius = log_uniform(rng, 0.87, 16)
    length = rng.uniform(1, 2) * max(40, 5 * radius)
    body = Body("straight tubes", f"radius {radius:.2f}")
    ends = numpy.array([[0, 0, -length / 2], [0, 0, length / 2]])
    body.tables_have_radius = True
    return body.along(straight(*ends, radius), tips=[(*end, radius) for end in ends])


def bent_tube(rng):
    """Tori, helices and wavy tubes."""
    radius = log_uniform(rng, 1.5, 8)
    kind = rng.choice(["torus", "helix", "wave"])
    body = Body("bent tubes", f"{kind}, radius {radius:.2f}")
    bend = radius * rng.uniform(2.5, 5) + 4
    body.tables_have_radius = True
    if kind == "torus":
        t = numpy.linspace(0, 2 * numpy.pi, int(6.3 * bend) + 8)
        line = numpy.stack([bend * numpy.cos(t), bend * numpy.sin(t), 0 * t, 0 * t + radius], 1)
        body.cycles = 1
        return body.along(line, tips=[])
    if kind == "helix":
        pitch = 2 * radius + rng.uniform(6, 4 * radius + 8)
        t = numpy.linspace(0, 2 * numpy.pi * rng.uniform(0.7, 1.6), int(9 * bend))
        line = numpy.stack([bend * numpy.cos(t), bend * numpy.sin(t), pitch * t / (2 * numpy.pi), 0 * t + radius], 1)
    else:
        t = numpy.linspace(0, numpy.pi * rng.uniform(1, 3), int(9 * bend))
        line = numpy.stack([bend * t, bend * 0.6 * numpy.sin(t), bend * 0.3 * numpy.cos(0.7 * t), 0 * t + radius], 1)
    return body.along(line, tips=[line[0], line[-1]])


def flat_tube(rng):
    """Elliptical cross-sections."""
    ratio = rng.uniform(1.8, 3.2)
    thin = rng.uniform(2.5, 6)
    half = rng.uniform(25, 45)
    wide = ratio * thin
    body = Body("flat tubes", f"{2 * wide:.1f} x {2 * thin:.1f}")
    # Its ends are half ellipsoids, so that it is thinnest where it ends.
    end = half - wide
    body.along(straight((0, 0, -end), (0, 0, end), thin), tips=[(0, 0, -end, wide), (0, 0, end, wide)],
               length=(2 * end, 2 * half))
    body.reach = (wide, thin, half)

    def distance(p):
        z = numpy.maximum(numpy.abs(p[..., 2]) - end, 0)
        scaled = numpy.stack([p[..., 0] / wide, p[..., 1] / thin, z / wide])
        value = numpy.sqrt((scaled ** 2).sum(0))
        slope = numpy.sqrt((scaled[0] / wide) ** 2 + (scaled[1] / thin) ** 2 + (scaled[2] / wide) ** 2)
        return value * (value - 1) / numpy.maximum(slope, 1e-9)

    body.distance = distance
    return body


def fork(rng):
    """A stem whose arms leave at 20 to 60 degrees from each other."""
    radius = log_uniform(rng, 2.5, 8)
    angle = numpy.radians(rng.uniform(20, 60))
    thinner = radius * rng.uniform(0.6, 1)
    # Arms overlap until their lines are as far apart as both are thick.
    apart = 2 * thinner / (2 * numpy.tan(angle / 2))
    arm = apart + rng.uniform(4, 8) * thinner
    stem = rng.uniform(5, 9) * radius
    body = Body("forks", f"{numpy.degrees(angle):.0f} degrees, radii {radius:.1f} and {thinner:.1f}")
    ends = [numpy.array([s * arm * numpy.sin(angle / 2), 0, arm * numpy.cos(angle / 2)]) for s in (-1, 1)]
    lines = [straight((0, 0, -stem), (0, 0, 0), radius, thinner)] + [straight((0, 0, 0), end, thinner) for end in ends]
    whole = sum(line_length(line) for line in lines)
    return body.along(*lines, tips=[(0, 0, -stem, radius), *((*end, thinner) for end in ends)],
                      length=(whole - apart - radius, whole))


def ring_with_arms(rng):
    radius = log_uniform(rng, 2, 6)
    bend = radius * rng.uniform(3, 6)
    t = numpy.linspace(0, 2 * numpy.pi, int(6.3 * bend) + 8)
    lines = [numpy.stack([bend * numpy.cos(t), bend * numpy.sin(t), 0 * t, 0 * t + radius], 1)]
    tips = []
    for start in numpy.linspace(0, 2 * numpy.pi, rng.integers(1, 4), endpoint=False):
        way = numpy.array([numpy.cos(start), numpy.sin(start), 0])
        end = way * (bend + rng.uniform(4, 8) * radius)
        lines.append(straight(way * bend, end, radius))
        tips.append((*end, radius))
    body = Body("rings", f"radius {radius:.1f} around {bend:.0f}, {len(tips)} arms")
    body.cycles = 1
    return body.along(*lines, tips=tips)


def stub(rng):
    """A short thin lateral on a thick stem."""
    stem = log_uniform(rng, 8, 30)
    radius, height = rng.uniform(1.8, 3), rng.uniform(9, 14)
    half = rng.uniform(1.2, 2) * stem + 15
    turn, at = rng.uniform(0, 2 * numpy.pi), rng.uniform(-0.3, 0.3) * half
    way = numpy.array([numpy.cos(turn), numpy.sin(turn), 0])
    foot = numpy.array([0, 0, at])
    top = foot + way * (stem + height - radius)
    body = Body("stubs", f"radius {radius:.1f}, {height:.0f} high on {stem:.0f}")
    return body.along(straight((0, 0, -half), (0, 0, half), stem), straight(foot, top, radius),
                      tips=[(0, 0, -half, stem), (0, 0, half, stem), (*top, radius)])


def tree(rng, thinnest=1.6):
    """A stem with laterals, and laterals of these, that nowhere touch."""
    radius = log_uniform(rng, 2.2, 5) * thinnest
    lines, tips = [], []
    cut = 0.0  # in a parent, a lateral's line may go straight to the parent's

    def clear(line, start, parent):
        for other in lines:
            free = line[int(3 * start[3]) + 6:] if other is parent else line
            gaps = numpy.linalg.norm(free[:, None, :3] - other[None, ::2, :3], axis=2)
            if (gaps - free[:, None, 3] - other[None, ::2, 3]).min() < 4:
                return False
        return True

    def grow(start, way, r, length, level, lean=numpy.pi / 2, parent=None):
        nonlocal cut
        t = numpy.arange(0, length, 1.0)
        side, other = frame(way)
        sway = rng.uniform(0, 0.12, 2) * length
        curve = (start[:3] + t[:, None] * way + numpy.sin(numpy.pi * t / length)[:, None] *
                 (sway[0] * side + sway[1] * other))
        line = numpy.hstack([curve, (r * (1 - 0.5 * t / length))[:, None]])
        line[:, 3] = numpy.maximum(line[:, 3], thinnest)
        if lines and not clear(line, start, parent):
            return
        lines.append(line)
        tips.append(line[-1])
        cut += start[3] * (1 / numpy.sin(lean) - 1)
        if level == 2:
            return
        for at in numpy.linspace(0.25, 0.75, rng.integers(1, 4)):
            base = line[int(at * len(line))]
            turn = rng.uniform(0, 2 * numpy.pi)
            out = numpy.cos(turn) * side + numpy.sin(turn) * other
            lean = numpy.radians(rng.uniform(40, 80))
            thin = max(thinnest, 0.6 * base[3])
            grow(base, numpy.cos(lean) * way + numpy.sin(lean) * out, thin, rng.uniform(8, 14) * thin + 2 * base[3],
                 level + 1, lean, line)

    start = numpy.array([0, 0, 0, radius])
    grow(start, direction(rng), radius, rng.uniform(14, 20) * radius, 0)
    tips.append(start)
    whole = sum(line_length(line) for line in lines)
    return Body("trees", f"{len(tips)} tips, stem radius {radius:.1f}").along(*lines, tips=tips,
                                                                             length=(whole - cut, whole))


def rough(rng):
    """One of the others with noise of half a voxel on its surface, which would break what is thinner."""
    while True:
        body = FAMILIES[str(rng.choice(["straight tubes", "flat tubes", "forks", "rings"]))](rng)
        if min(line[:, 3].min() for line in body.lines) > 2:
            break
    body.roughness = 0.5
    body.parameters = f"{body.family}, {body.parameters}"
    body.family = "rough bodies"
    return body


def thick_rough(rng):
    radius = rng.uniform(8, 22)
    half = rng.uniform(2, 4) * radius
    body = Body("thick rough tubes", f"radius {radius:.1f}")
    body.roughness = rng.uniform(0.3, 0.5)
    body.tables_have_radius = True
    return body.along(straight((0, 0, -half), (0, 0, half), radius), tips=[(0, 0, -half, radius), (0, 0, half, radius)])


def flipped(rng):
    """A tree of which a quarter of all voxels at the boundary are of the wrong kind, and the options that mend it."""
    body = tree(rng, 2.5)
    body.family = "flipped voxels"
    body.flips = 0.25
    body.options = {"denoise": True, "mend_shape": True, "min_voxels": 27}
    return body


def flat_wall(rng, thickness):
    half = rng.uniform(1.5, 2.5) * thickness + 12
    body = Body("walls", f"flat, {thickness:.1f} thick")
    body.reach = (half, half, thickness / 2)
    body.distance = lambda p: numpy.maximum(numpy.abs(p[..., 2]) - thickness / 2,
                                            numpy.maximum(numpy.abs(p[..., 0]), numpy.abs(p[..., 1])) - half)
    body.sheet = lambda p: (numpy.abs(p[:, 2]), half - numpy.abs(p[:, :2]).max(1))
    side = numpy.arange(-half, half, 1.0)
    body.middle = numpy.array([(a, b, 0) for a in side for b in side])
    body.thickness = thickness
    return body


def wall(rng):
    """Flat, or part of a sphere."""
    thickness = rng.uniform(3, 16)
    if rng.random() < 0.5:
        return flat_wall(rng, thickness)
    bend, angle = rng.uniform(1.5, 4) * thickness + 6, rng.uniform(0.8, 1.3)
    body = Body("walls", f"curved by {bend:.0f}, {thickness:.1f} thick")
    body.reach = (bend + thickness,) * 3

    def sheet(p):
        far = numpy.linalg.norm(p, axis=-1)
        return numpy.abs(far - bend), bend * (angle - numpy.arccos(p[..., 2] / numpy.maximum(far, 1e-9)))

    def distance(p):
        off, rim = sheet(p)
        return numpy.maximum(off - thickness / 2, -rim)

    body.distance, body.sheet = distance, sheet
    points = rng.normal(size=(4000, 3))
    body.middle = bend * points / numpy.linalg.norm(points, axis=1)[:, None]
    body.thickness = thickness
    return body


FAMILIES = {
    "straight tubes": tube,
    "bent tubes": bent_tube,
    "flat tubes": flat_tube,
    "forks": fork,
    "rings": ring_with_arms,
    "stubs": stub,
    "trees": tree,
    "rough bodies": rough,
    "thick rough tubes": thick_rough,
    "flipped voxels": flipped,
    "walls": wall,
}
