#!/usr/bin/python3
"""Fits the built-in skin to a MakeHuman body and writes its table, engine/core/palpate/body/skin_numbers.txt.

    tools/fit_skin.py --base base.obj --target caucasian-male-young.target \\
        --target universal-male-young-averagemuscle-averageweight.target \\
        [--scan back_scan.obj] -o engine/core/palpate/body/skin_numbers.txt

Inputs are MakeHuman's base mesh hm08 and two of its shape targets (CC0 since September 2020; makehumancommunity.org). The
product does not need them: the table in the source is what this tool wrote. `--scan` only reports how far a patch of the
same body lies from the fitted surface.

What it does: base + 1.0 x each target, the group `body`, two rounds of Loop subdivision, scaled to 1750 mm; the back of it
seen from the axis (x = 0, z = -60) is fitted by one scalar, the radius over (angle about the axis, height y), a tensor-product
cubic B-spline that is mirror-symmetric; then the outline of the trimmed back is traced on the fitted surface.
Needs Python 3 and numpy only.
"""
import argparse

import numpy as np

STATURE_MM = 1750.0
# From the body's scaled frame to the back's frame: y = 0 is 490 mm below, z = 0 lies 120 mm ventral of the most dorsal point.
SHIFT_MM = np.array([0.0, -490.0, 34.472])
AXIS_Z_MM = -60.0       # any axis from -150 to -40 fits equally well
HALF_ANGLE = 1.2405     # atan(175 / 60): the widest point of the outline, at z = 0
LOW_MM, HIGH_MM = -292.0, 200.0  # -292 covers the spine of L5
HALF_WIDTH_MM = 175.0
ACROSS, ALONG = 20, 24  # coefficients; half of ACROSS is stored
SMOOTHING = 1e-4        # weight of the second differences of the coefficients
ARMPIT_MM = 14.5        # height below which z >= 0 bounds the patch, above which |x| <= 175 does
# The crest of the shoulder as (angle in degrees, y), from the tip to the neck corner, where the surface turns to the chest.
RIDGE = [(67.3, 153.2), (65.2, 157.0), (61.9, 160.9), (58.2, 165.2), (53.0, 173.0), (48.5, 181.8), (44.6, 190.4), (42.3, 197.4),
         (40.9, 200.0)]
OUTLINE_STEP_MM = 4.0


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
    return np.array(points), np.array(quads)


def add_target(points, path):
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if len(words) == 4 and words[0] != "#":
            points[int(words[0])] += [float(w) for w in words[1:]]


def loop_subdivide(points, triangles):
    """One round of Loop subdivision of a closed mesh."""
    count = len(points)
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), 1)
    opposite = np.concatenate([triangles[:, 2], triangles[:, 0], triangles[:, 1]])
    unique, edge_of = np.unique(edges[:, 0] * count + edges[:, 1], return_inverse=True)
    a, b = unique // count, unique % count
    wings = np.zeros((len(unique), 3))
    np.add.at(wings, edge_of, points[opposite])
    middle = 3 / 8 * (points[a] + points[b]) + wings / 8
    valence, ring = np.zeros(count), np.zeros((count, 3))
    for here, there in ((a, b), (b, a)):
        np.add.at(valence, here, 1)
        np.add.at(ring, here, points[there])
    beta = (5 / 8 - (3 / 8 + np.cos(2 * np.pi / valence) / 4) ** 2) / valence
    moved = points * (1 - valence * beta)[:, None] + ring * beta[:, None]
    e0, e1, e2 = edge_of.reshape(3, -1) + count
    t0, t1, t2 = triangles.T
    split = [np.stack(t, 1) for t in ((t0, e0, e2), (t1, e1, e0), (t2, e2, e1), (e0, e1, e2))]
    return np.concatenate([moved, middle]), np.concatenate(split)


def build_body(options):
    points, quads = read_body(options.base)
    for target in options.target:
        add_target(points, target)
    used, flat = np.unique(quads, return_inverse=True)
    points, quads = points[used], flat.reshape(quads.shape)
    points *= STATURE_MM / np.ptp(points[:, 1])
    points = points * [-1, 1, -1] + SHIFT_MM  # MakeHuman looks along +z, its left is +x
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    for _ in range(2):
        points, triangles = loop_subdivide(points, triangles)
    return points, triangles


# ---------------------------------------------------------------- the spline

def basis(count, unit):
    """Row i holds the `count` clamped uniform cubic B-splines at unit[i]."""
    spans = count - 3
    knots = np.r_[[0.0] * 3, np.linspace(0, 1, spans + 1), [1.0] * 3]
    unit = np.clip(unit, 0, 1)
    first = np.minimum((unit * spans).astype(int), spans - 1)
    values = np.zeros((len(unit), 4))
    values[:, 0] = 1
    for degree in range(1, 4):  # Cox - de Boor
        saved = np.zeros(len(unit))
        for r in range(degree):
            high, low = knots[first + 3 + r + 1], knots[first + 3 + r + 1 - degree]
            part = values[:, r] / (high - low)
            values[:, r] = saved + (high - unit) * part
            saved = (unit - low) * part
        values[:, degree] = saved
    rows = np.zeros((len(unit), count))
    np.put_along_axis(rows, first[:, None] + np.arange(4), values, 1)
    return rows


def mirror_fold():
    """Maps the stored half of the rows to all of them."""
    fold = np.zeros((ACROSS, ACROSS // 2))
    for row in range(ACROSS):
        fold[row, min(row, ACROSS - 1 - row)] = 1
    return fold


def design(angle, y):
    across = basis(ACROSS, (angle + HALF_ANGLE) / (2 * HALF_ANGLE)) @ mirror_fold()
    along = basis(ALONG, (y - LOW_MM) / (HIGH_MM - LOW_MM))
    return (across[:, :, None] * along[:, None, :]).reshape(len(angle), -1)


def second_differences(count):
    return np.diff(np.eye(count), 2, axis=0)


def cylinder(points):
    z = points[:, 2] - AXIS_Z_MM
    return np.arctan2(points[:, 0], z), np.hypot(points[:, 0], z)


def fit(points, weights):
    angle, radius = cylinder(points)
    rows = design(angle, points[:, 1])
    weights = weights / weights.sum()
    rough = np.concatenate([np.kron(second_differences(ACROSS) @ mirror_fold(), np.eye(ALONG)),
                            np.kron(mirror_fold(), second_differences(ALONG))])
    normal = rows.T @ (rows * weights[:, None]) + SMOOTHING / (ACROSS * ALONG) * rough.T @ rough
    table = np.linalg.solve(normal, rows.T @ (weights * radius))
    return table.reshape(-1, ALONG).round(1)


def radius_at(table, angle, y):
    return design(angle, y) @ table.ravel()


def back_samples(points, triangles):
    """Centres of the body's triangles inside the outline, weighted so that the distance along the normal counts."""
    corners = points[triangles]
    centre = corners.mean(1)
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
    size = np.linalg.norm(area, axis=1)
    radial = (centre - [0, 0, AXIS_Z_MM]) * [1, 0, 1]
    facing = (area * radial).sum(1) / (size * np.linalg.norm(radial, axis=1))
    ridge_angle, ridge_y = np.array(RIDGE).T
    limit = np.where(centre[:, 1] < ridge_y[0], 90, np.interp(centre[:, 1], ridge_y, ridge_angle))
    angle, _ = cylinder(centre)
    chosen = ((abs(centre[:, 0]) < HALF_WIDTH_MM) & (centre[:, 2] > 0) & (centre[:, 1] > LOW_MM) & (centre[:, 1] < HIGH_MM)
              & (facing > 0.1) & (abs(np.degrees(angle)) < limit))
    return centre[chosen], (size * facing**2)[chosen]


# ---------------------------------------------------------------- the outline

def x_at(table, angle, y):
    return radius_at(table, angle, y) * np.sin(angle)


def bisect(inside, low, high):
    """The angles between `low` (inside) and `high` (outside) where `inside` turns false."""
    for _ in range(30):
        middle = (low + high) / 2
        keep = inside(middle)
        low, high = np.where(keep, middle, low), np.where(keep, high, middle)
    return low


def flank_angle(table, y):
    """Where z = 0: r cos(angle) = -AXIS_Z."""
    inside = lambda angle: radius_at(table, angle, y) * np.cos(angle) > -AXIS_Z_MM
    return np.degrees(bisect(inside, np.ones_like(y), np.full_like(y, HALF_ANGLE)))


def arm_angle(table, y):
    """The first angle where x = 175; nan where the surface stays inside."""
    tried = np.radians(np.arange(46, 71.1, 0.25))
    x = np.stack([x_at(table, np.full_like(y, angle), y) for angle in tried], 1)
    outside = x > HALF_WIDTH_MM
    high = tried[outside.argmax(1)]
    angle = bisect(lambda angle: x_at(table, angle, y) < HALF_WIDTH_MM, high - np.radians(0.25), high)
    return np.where(outside.any(1), np.degrees(angle), np.nan)


def resample(line):
    """The same line with points about OUTLINE_STEP_MM apart, ends kept; angles count as arc at a radius of 170 mm."""
    flat = line * [np.radians(1) * 170, 1]
    length = np.r_[0, np.cumsum(np.linalg.norm(np.diff(flat, axis=0), axis=1))]
    at = np.linspace(0, length[-1], int(np.ceil(length[-1] / OUTLINE_STEP_MM)) + 1)
    return np.stack([np.interp(at, length, column) for column in line.T], 1)


def smooth(line, pieces=3):
    """The Catmull-Rom curve through the points."""
    padded = np.concatenate([[2 * line[0] - line[1]], line, [2 * line[-1] - line[-2]]])
    curve = []
    for p0, p1, p2, p3 in zip(padded, padded[1:], padded[2:], padded[3:]):
        for t in np.arange(pieces) / pieces:
            curve.append(p1 + t / 2 * (p2 - p0 + t * (2 * p0 - 5 * p1 + 4 * p2 - p3 + t * (3 * (p1 - p2) + p3 - p0))))
    return np.array(curve + [line[-1]])


def trace_outline(table):
    """Right half of the outline as three lines of (degrees, y), each from its low end to its high end."""
    low = np.linspace(LOW_MM, ARMPIT_MM + 2, 2000)
    flank = np.stack([flank_angle(table, low), low], 1)
    flank = flank[x_at(table, np.radians(flank[:, 0]), low) <= HALF_WIDTH_MM]
    high = np.linspace(flank[-1, 1], RIDGE[0][1], 2000)
    arm = np.stack([arm_angle(table, high), high], 1)
    arm = arm[~np.isnan(arm[:, 0])]
    arm[0] = flank[-1]
    ridge = smooth(np.concatenate([arm[-1:], np.array(RIDGE)]))
    return [resample(flank), resample(arm), ridge]


# ---------------------------------------------------------------- the report and the table

def scan_report(table, path):
    points = np.array([[float(w) for w in line.split()[1:4]] for line in open(path) if line.startswith("v ")])
    faces = np.array([[int(w.split("/")[0]) - 1 for w in line.split()[1:4]] for line in open(path) if line.startswith("f ")])
    area = np.linalg.norm(np.cross(*(points[faces[:, i]] - points[faces[:, 0]] for i in (1, 2))), axis=1)
    weight = np.bincount(faces.ravel(), np.repeat(area, 3), len(points))
    angle, radius = cylinder(points)
    here = radius_at(table, angle, points[:, 1])
    turn = (radius_at(table, angle + 1e-4, points[:, 1]) - radius_at(table, angle - 1e-4, points[:, 1])) / 2e-4
    climb = (radius_at(table, angle, points[:, 1] + 0.01) - radius_at(table, angle, points[:, 1] - 0.01)) / 0.02
    distance = (here - radius) / np.sqrt(1 + (turn / here) ** 2 + climb**2)
    rms = np.sqrt((weight * distance**2).sum() / weight.sum())
    print(f"{path}: RMS {rms:.3f} mm, p99 {np.percentile(abs(distance), 99):.2f} mm, max {abs(distance).max():.2f} mm")


HEADER = """# Written by tools/fit_skin.py; do not edit by hand.
#
# Provenance: MakeHuman base mesh hm08 + 1.0 x caucasian-male-young + 1.0 x
# universal-male-young-averagemuscle-averageweight, released as CC0 by their owners in September 2020
# (makehumancommunity.org), scaled to a stature of 1750 mm.
"""


def write_table(path, table, outline):
    with open(path, "w", encoding="utf-8") as file:
        file.write(HEADER)
        file.write("\n# mm, a row for each angle\nSkinRow[] kSkinRadii\n")
        for row in table:
            file.write(", ".join(f"{v:.1f}" for v in row) + "\n")
        for name, line in zip(("Flank", "Arm", "Ridge"), outline):
            file.write(f"\n# angle_deg, y_mm\nOutlinePoint[] kOutline{name}\n")
            for a, y in line:
                file.write(f"{a:.3f}, {y:.2f}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--base", required=True, help="MakeHuman base mesh (OBJ, decimetres)")
    parser.add_argument("--target", action="append", default=[], help="shape target, added x 1.0; repeatable")
    parser.add_argument("--scan", action="append", default=[], help="patch of the same body to compare with (OBJ)")
    parser.add_argument("-o", "--output", required=True, help="file to write")
    options = parser.parse_args()
    samples, weights = back_samples(*build_body(options))
    table = fit(samples, weights)
    write_table(options.output, table, trace_outline(table))
    for scan in options.scan:
        scan_report(table, scan)


if __name__ == "__main__":
    main()
