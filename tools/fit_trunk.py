#!/usr/bin/python3
"""Fits the built-in trunk to a MakeHuman body and writes its table, engine/core/palpate/body/trunk/trunk_numbers.txt.

    tools/fit_trunk.py --base base.obj --target caucasian-male-young.target \\
        --target universal-male-young-averagemuscle-averageweight.target \\
        [--scan back_scan.obj] -o engine/core/palpate/body/trunk/trunk_numbers.txt

Inputs are MakeHuman's base mesh hm08 and two of its shape targets (CC0 since September 2020; makehumancommunity.org). The
product does not need them: the table in the source is what this tool wrote. `--scan` only reports how far a patch of the
same body lies from the fitted surface.

What it does: base + 1.0 x each target, the group `body`, scaled to 1750 mm and put into the body's frame; its signed distance
(mostly to the flat quads, a little to two rounds of Catmull-Clark subdivision, which smooths them), the deep gluteal cleft
blurred by 5 mm, neck, arms and thighs cut off and rounded; then a tricubic B-spline over a lattice of 18 mm, mirrored at
x = 0, by least squares at places near the skin, with second differences held small. Far from the skin only the sign is kept.
Needs Python 3, numpy and scipy; about five minutes and 2 GB.
"""
import argparse
from collections import deque

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linear
from scipy.spatial import cKDTree

from fit_skin import add_target

STATURE_MM = 1750.0
SHIFT_MM = np.array([0.005, -489.939, 34.273])  # from the scaled body, turned to face away, to the body's frame
STEP_MM = 18.0
LOW_MM = np.array([0.0, -580.0, -150.0])
HIGH_MM = np.array([325.0, 300.0, 160.0])
BAND_MM = 28.0          # how far from the skin the function is a distance
SMOOTHING = 0.35        # weight of second differences
FLAT_SHARE = 0.85       # of the flat quads in the distance; the rest is the subdivided body
OUTWARD_MM = 0.09       # corners of the quads stick out: the mean lies so far outside the flats
CLEFT_BLUR_MM = 5.0
SHOULDER_MM = np.array([168.0, 118.0, 25.0])  # on the axis of the right upper arm
ARM = np.array([0.70, -0.714, 0.0]) / np.hypot(0.70, 0.714)
ARM_MM = 122.0          # length of the stump
NECK_TOP_MM = np.array([0.0, 300.0, -8.0])
NECK = np.array([0.0, 0.97, -0.24])
NECK_END_MM = np.array([0.0, 262.0, -8.0])
THIGH = np.array([0.10, -0.995, 0.0])
THIGH_MM = np.array([95.0, -535.0, 0.0])
UNIT_MM = 0.025
DIGITS = [chr(c) for c in range(ord("#"), ord("~")) if chr(c) not in "\\+-?"]
SEED = 5


# ---------------------------------------------------------------- the body

def read_body(path):
    """Points of the whole file, quads of the group `body`."""
    points, quads, group = [], [], ""
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            points.append([float(w) for w in words[1:4]])
        elif words[0] == "g":
            group = words[1]
        elif words[0] == "f" and group == "body":
            quads.append([int(w.split("/")[0]) - 1 for w in words[1:]])
    return np.array(points), quads


def only_used(points, quads):
    used = np.unique(np.concatenate([np.array(q) for q in quads]))
    number = -np.ones(len(points), int)
    number[used] = np.arange(len(used))
    return points[used], [[int(number[i]) for i in q] for q in quads]


def body_in_frame(base, targets):
    points, quads = read_body(base)
    for target in targets:
        add_target(points, target)
    points, quads = only_used(points, quads)
    height = np.ptp(points[:, 1])
    points = points * (STATURE_MM / height) * np.array([-1.0, 1.0, -1.0]) + SHIFT_MM
    near = [q for q in quads if -640 < points[q][:, 1].mean() < 330 and abs(points[q][:, 0].mean()) < 420]
    return only_used(points, near)


def catmull_clark(points, quads):
    count = len(points)
    centres = np.array([points[q].mean(0) for q in quads])
    edges, faces_of_edge = {}, []
    for f, quad in enumerate(quads):
        for a, b in zip(quad, quad[1:] + quad[:1]):
            key = (min(a, b), max(a, b))
            if key not in edges:
                edges[key] = len(faces_of_edge)
                faces_of_edge.append([])
            faces_of_edge[edges[key]].append(f)
    ends = np.array(list(edges))
    middles = points[ends].mean(1)
    on_edge = middles.copy()
    for e, faces in enumerate(faces_of_edge):
        if len(faces) == 2:
            on_edge[e] = (points[ends[e]].sum(0) + centres[faces].sum(0)) / 4
    sum_centres, faces = np.zeros_like(points), np.zeros(count)
    for f, quad in enumerate(quads):
        for v in quad:
            sum_centres[v] += centres[f]
            faces[v] += 1
    sum_middles, valence = np.zeros_like(points), np.zeros(count)
    for side in range(2):
        np.add.at(sum_middles, ends[:, side], middles)
        np.add.at(valence, ends[:, side], 1)
    border = np.zeros(count, bool)
    border[ends[[len(f) == 1 for f in faces_of_edge]].ravel()] = True
    n = np.maximum(valence, 1)[:, None]
    moved = (sum_centres / np.maximum(faces, 1)[:, None] + 2 * sum_middles / n + (n - 3) * points) / n
    moved[border] = points[border]
    fine = []
    for f, quad in enumerate(quads):
        for i, a in enumerate(quad):
            b, before = quad[(i + 1) % len(quad)], quad[i - 1]
            fine.append([a, count + edges[min(a, b), max(a, b)], count + len(ends) + f,
                         count + edges[min(a, before), max(a, before)]])
    return np.concatenate([moved, on_edge, centres]), fine


# ---------------------------------------------------------------- its signed distance

class Samples:
    """A surface as dense points with normals."""

    def __init__(self, points, quads, per_side):
        a, b, c, d = [points[np.array([(q + q[-1:])[i] for q in quads])] for i in range(4)]
        places, normals = [], []
        for u in (np.arange(per_side) + 0.5) / per_side:
            for v in (np.arange(per_side) + 0.5) / per_side:
                places.append(a * (1 - u) * (1 - v) + b * u * (1 - v) + c * u * v + d * (1 - u) * v)
                normal = np.cross((b - a) * (1 - v) + (c - d) * v, (d - a) * (1 - u) + (c - b) * u)
                normals.append(normal / (np.linalg.norm(normal, axis=1)[:, None] + 1e-12))
        self.places, self.normals = np.concatenate(places), np.concatenate(normals)
        self.tree = cKDTree(self.places)

    def distance(self, x):
        far, i = self.tree.query(x, workers=-1)
        along = ((x - self.places[i]) * self.normals[i]).sum(1)
        return np.where(far < 6, along, np.sign(along) * far)


def smooth_max(a, b, k):
    q = np.maximum(k - abs(a - b), 0)
    return np.maximum(a, b) + q * q / (4 * k)


def rounded_cut(a, b, r):
    qa, qb = a + r, b + r
    return np.minimum(np.maximum(qa, qb), 0) + np.hypot(np.maximum(qa, 0), np.maximum(qb, 0)) - r


def smooth_step(t):
    t = np.clip(t, 0, 1)
    return t * t * (3 - 2 * t)


class Trunk:
    def __init__(self, points, quads):
        self.flat = Samples(points, quads, 12)
        fine = catmull_clark(*catmull_clark(points, quads))
        self.smooth = Samples(fine[0], fine[1], 3)
        ball = np.random.default_rng(1).normal(size=(24, 3))
        ball *= CLEFT_BLUR_MM / np.linalg.norm(ball, axis=1)[:, None]
        self.blur = np.concatenate([ball, -ball, 0.5 * ball])

    def body(self, x):
        return FLAT_SHARE * self.flat.distance(x) + (1 - FLAT_SHARE) * self.smooth.distance(x) - OUTWARD_MM

    def with_soft_cleft(self, x):
        value = self.body(x)
        deep = smooth_step(np.clip((30 - abs(x[:, 0])) / 14, 0, 1) * np.clip((-300 - x[:, 1]) / 40, 0, 1) *
                           np.clip((x[:, 1] + 500) / 30, 0, 1))
        k = deep > 0
        if k.any():
            mean = np.mean([self.body(x[k] + offset) for offset in self.blur], axis=0)
            value[k] += deep[k] * (mean - value[k])
        return value

    def distance(self, x):
        x = np.array(x)
        x[:, 0] = abs(x[:, 0])
        across, up, back = x.T
        value = self.with_soft_cleft(x)
        # Chin and jaw give way to a plain neck.
        neck = (np.hypot(across / 58.5, (back + 2) / 57) - 1) * 57
        share = smooth_step((up - 0.5 * back - 198) / 38)
        value = value * (1 - share) + neck * share
        value = smooth_max(value, (x - NECK_TOP_MM) @ NECK, 5)
        value = rounded_cut(value, (x - NECK_END_MM) @ NECK, 20)
        arm = np.minimum(np.minimum((x - SHOULDER_MM) @ ARM - ARM_MM, across - 195), up + 120)
        value = rounded_cut(value, arm, 26)
        return rounded_cut(value, (x - THIGH_MM) @ THIGH, 26)


# ---------------------------------------------------------------- the spline

class Lattice:
    def __init__(self):
        self.shape = tuple(int(np.ceil(HIGH_MM[i] / STEP_MM)) + 2 if i == 0 else
                           int(np.ceil((HIGH_MM[i] - LOW_MM[i]) / STEP_MM)) + 4 for i in range(3))
        self.count = int(np.prod(self.shape))

    @staticmethod
    def basis(t):
        return np.stack([(1 - t) ** 3 / 6, (3 * t**3 - 6 * t**2 + 4) / 6, (-3 * t**3 + 3 * t**2 + 3 * t + 1) / 6, t**3 / 6], -1)

    def rows(self, x):
        place = [abs(x[:, 0]) / STEP_MM, (x[:, 1] - LOW_MM[1]) / STEP_MM + 1, (x[:, 2] - LOW_MM[2]) / STEP_MM + 1]
        cell = [np.floor(p).astype(int) for p in place]
        weight = [self.basis(p - c) for p, c in zip(place, cell)]
        columns, values = [], []
        for i in range(4):
            for j in range(4):
                for k in range(4):
                    columns.append((abs(cell[0] + i - 1) * self.shape[1] + cell[1] + j - 1) * self.shape[2] + cell[2] + k - 1)
                    values.append(weight[0][:, i] * weight[1][:, j] * weight[2][:, k])
        return np.stack(columns, 1), np.stack(values, 1)


def gradient(function, x, step=0.5):
    return np.stack([(function(x + step * e) - function(x - step * e)) / (2 * step) for e in np.eye(3)], 1)


def fit(trunk, lattice):
    random = np.random.default_rng(SEED)
    places = random.uniform(LOW_MM + [0, 8, 8], HIGH_MM - 8, (500000, 3))
    values = trunk.distance(places)
    in_band = abs(values) < BAND_MM
    places, values = places[in_band], values[in_band]
    near, near_values = places.copy(), values.copy()
    for _ in range(3):
        slope = gradient(trunk.distance, near)
        slope /= np.linalg.norm(slope, axis=1)[:, None] + 1e-9
        near = near - 0.9 * near_values[:, None] * slope
        near_values = trunk.distance(near)
    good = (abs(near_values) < 3) & np.all(near > LOW_MM, 1) & np.all(near < HIGH_MM, 1)
    near, near_values = near[good], near_values[good]
    groin = (abs(near[:, 0]) < 45) & (near[:, 1] < -385) & (near[:, 2] < -35)
    x = np.concatenate([near, places])
    wanted = np.concatenate([near_values, values])
    weight = np.concatenate([np.where(groin, 0.15, 1.0), 0.25 * np.exp(-((values / 12) ** 2)) + 0.01])
    columns, entries = lattice.rows(x)
    a = sparse.csr_matrix(((entries * weight[:, None]).ravel(), columns.ravel(), np.arange(0, 64 * len(x) + 1, 64)),
                          shape=(len(x), lattice.count))
    active = np.zeros(lattice.count, bool)
    active[columns.ravel()] = True
    index = np.arange(lattice.count).reshape(lattice.shape)
    triples = []
    for axis in range(3):
        line = np.moveaxis(index, axis, 0)
        three = np.stack([line[:-2].ravel(), line[1:-1].ravel(), line[2:].ravel()], 1)
        triples.append(three[active[three].all(1)])
    triples = np.concatenate(triples)
    stiff = SMOOTHING * 0.06 * np.sqrt(len(x) / lattice.count)
    bend = sparse.csr_matrix((np.tile([stiff, -2 * stiff, stiff], len(triples)), triples.ravel(),
                              np.arange(0, 3 * len(triples) + 1, 3)), shape=(len(triples), lattice.count))
    normal = (a.T @ a + bend.T @ bend + 1e-6 * sparse.identity(lattice.count)).tocsc()
    solver = linear.splu(normal, permc_spec="MMD_AT_PLUS_A", options=dict(SymmetricMode=True))
    return solver.solve(a.T @ (weight * wanted)), active


# ---------------------------------------------------------------- what comes out

def signs(coefficients, active, shape):
    """Outside or inside for every coefficient, spread from those that were fitted."""
    sign = np.where(active, np.where(coefficients > 0, 1, -1), 0).reshape(shape)
    queue = deque(map(tuple, np.argwhere(sign != 0)))
    while queue:
        here = queue.popleft()
        for axis in range(3):
            for step in (-1, 1):
                there = list(here)
                there[axis] += step
                there = tuple(there)
                if all(0 <= there[k] < shape[k] for k in range(3)) and sign[there] == 0:
                    sign[there] = sign[here]
                    queue.append(there)
    return sign.ravel()


def table_text(coefficients, active, shape):
    base = len(DIGITS)
    text = ""
    for value, known, sign in zip(coefficients, active, signs(coefficients, active, shape)):
        if not known:
            text += "+" if sign > 0 else "-"
            continue
        level = min(max(int(round(value / UNIT_MM)) + base * base // 2, 0), base * base - 1)
        text += DIGITS[level // base] + DIGITS[level % base]
    lines = [text[i:i + 112] for i in range(0, len(text), 112)]
    return ("# Written by tools/fit_trunk.py; do not edit by hand.\n#\n"
            "# Provenance: MakeHuman base mesh hm08 + 1.0 x caucasian-male-young + 1.0 x\n"
            "# universal-male-young-averagemuscle-averageweight, released as CC0 by their owners in September 2020\n"
            "# (makehumancommunity.org), scaled to a stature of 1750 mm, its neck, arms and thighs cut off and rounded.\n"
            "\ntext kTrunkTable\n" + "".join(f'"{line}"\n' for line in lines))


def report(name, places, function):
    """Distance of places of the body, where it is trunk, to the fitted skin."""
    up, across = places[:, 1], abs(places[:, 0])
    arm = (np.stack([across, up, places[:, 2]], 1) - SHOULDER_MM) @ ARM
    groin = (across < 45) & (up < -385) & (places[:, 2] < -35)
    places = places[(up > -500) & (up < 165) & (across < 260) & ((arm < 70) | (up < -120)) & ~groin]
    off = function(places) / np.linalg.norm(gradient(function, places, 0.3), axis=1)
    print(f"{name}: {len(places)} places, RMS {np.sqrt((off**2).mean()):.3f} mm, 99 % within "
          f"{np.percentile(abs(off), 99):.2f}, worst {abs(off).max():.2f} at {places[abs(off).argmax()].round()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--base", required=True)
    parser.add_argument("--target", action="append", default=[])
    parser.add_argument("--scan")
    parser.add_argument("-o", "--out", required=True)
    arguments = parser.parse_args()
    points, quads = body_in_frame(arguments.base, arguments.target)
    trunk, lattice = Trunk(points, quads), Lattice()
    coefficients, active = fit(trunk, lattice)

    def fitted(x):
        columns, values = lattice.rows(x)
        return (coefficients[columns] * values).sum(1)

    report("the body's flat quads", trunk.flat.places[::7], fitted)
    report("their corners", points, fitted)
    if arguments.scan:
        scan = [[float(w) for w in line.split()[1:4]] for line in open(arguments.scan) if line.startswith("v ")]
        report("the scan", np.array(scan), fitted)
    with open(arguments.out, "w", encoding="utf-8") as out:
        out.write(table_text(coefficients, active, lattice.shape))
    print(f"lattice {lattice.shape}, {active.sum()} coefficients -> {arguments.out}")


if __name__ == "__main__":
    main()
