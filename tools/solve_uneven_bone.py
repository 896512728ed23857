#!/usr/bin/python3
"""Presses and drags skin over uneven bone by finite elements; writes where a tenth of the motion is left.

    tools/solve_uneven_bone.py -o tests/data/golden/uneven_bone.json

The truth that regions which follow the anatomy are judged by (docs/explanation/deformation.md). It shares nothing
with the product: small strains, elastic layers (skin 2 mm 150 kPa, fat up to 8 mm 10 kPa, at least 3 mm of muscle 27 kPa, Poisson
0.48) on a rigid base. Skin and base change along x only; the load is round. So the motion is a Fourier series in y, and
each of its terms a plane problem in x and z: quadrilaterals of 8 nodes, 2 x 2 points, 1.2 mm wide near the loads, 10 rows.
A press: 8 mm in radius, p ~ sqrt(1 - (r/8)^2) along the normal. A drag: 6 mm in radius, even, along x or y in the tangent
plane. Radii lie in the tangent plane of the load, 0 to 180 degree from +x by steps of 30, and end where the part of the
motion along the load falls below a tenth (a quarter: 2 mm of a press of 8 mm) of that in the middle.

Needs Python 3, numpy and scipy; some minutes.
"""
import argparse
import json

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linear
from scipy.special import j1

NU = 0.48
YOUNG_KPA = (150.0, 10.0, 27.0)  # skin, fat, muscle
SKIN_MM, FAT_MM, LEAST_MUSCLE_MM = 2.0, 8.0, 3.0
ROWS = (2, 3, 5)                 # of elements in each layer
HALF_WIDTH_MM = 110.0            # both ends held
PERIOD_MM = 300.0                # along y
TERMS = 56
PRESS_MM, DRAG_MM = 8.0, 6.0     # radii of the loads
DEGREES = np.arange(0, 181, 30)
FLAT_MM = (9, 10, 12, 15, 20, 25, 35, 45)


def step(x):
    x = np.clip(x, 0.0, 1.0)
    return x * x * (3.0 - 2.0 * x)


def level(z):
    return lambda x: 0.0 * x + z


# name: height of the skin and of the base over x (mm), where the loads stand
CASES = {
    "rib": (level(0), lambda x: -25 + 15 * step((10 - abs(x)) / 4), (0, 8, 12, 16, 22)),
    "step": (level(0), lambda x: -40 + 28 * step((5 - x) / 10), (-20, -10, -4, 4, 10, 20)),
    "spine": (lambda x: -8 * np.exp(-(x / 14) ** 2), lambda x: -45 + 25 * step((10 - abs(x)) / 5), (0, 10, 16, 22, 30)),
    "furrow": (lambda x: -8 * np.exp(-(x / 12) ** 2), level(-35), (0, 10, 18, 26)),
    "cleft": (lambda x: -15 * np.exp(-(x / 5) ** 2), level(-45), (8, 12, 18, 26)),
    # Held back: the rules were chosen on those above.
    "ribs": (level(0), lambda x: -21 + 9 * step((10 - abs(abs(x) - 13)) / 5), (0, 6, 13, 22)),
    "seam": (lambda x: -6 * np.exp(-(x / 8) ** 2), lambda x: -38 + 16 * step((20 - x) / 30), (-24, -9, 0, 12, 24)),
}


# ---------------------------------------------------------------- elements

def elastic(young):
    lame, shear = young * NU / ((1 + NU) * (1 - 2 * NU)), young / (2 * (1 + NU))
    matrix = np.diag([2 * shear] * 3 + [shear] * 3)
    matrix[:3, :3] += lame
    return matrix


def shape(xi, eta):
    """Of the 8 nodes: values and derivatives by xi and eta. Corners first, then the middles of the sides."""
    a, b = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1])
    corner = 0.25 * (1 + a * xi) * (1 + b * eta) * (a * xi + b * eta - 1)
    corner_xi = 0.25 * a * (1 + b * eta) * (2 * a * xi + b * eta)
    corner_eta = 0.25 * b * (1 + a * xi) * (2 * b * eta + a * xi)
    flat, tall = 0.5 * (1 - xi * xi), 0.5 * (1 - eta * eta)
    side = [flat * (1 - eta), tall * (1 + xi), flat * (1 + eta), tall * (1 - xi)]
    side_xi = [-xi * (1 - eta), tall, -xi * (1 + eta), -tall]
    side_eta = [-flat, -eta * (1 + xi), flat, -eta * (1 - xi)]
    return np.append(corner, side), np.append(corner_xi, side_xi), np.append(corner_eta, side_eta)


def columns():
    half, width = [0.0], 1.2
    while half[-1] < HALF_WIDTH_MM:
        if half[-1] > 42:
            width = min(1.15 * width, 7.0)
        half.append(half[-1] + width)
    return np.array([-x for x in half[:0:-1]] + half)


class Block:
    """Layers between a skin and a base; the motion of its skin under loads."""

    def __init__(self, skin, base):
        xs = columns()
        self.columns, rows = len(xs) - 1, sum(ROWS)
        self.x = np.interp(np.arange(2 * self.columns + 1) / 2, np.arange(self.columns + 1), xs)
        self.top = skin(self.x)
        self.arc = np.append(0.0, np.cumsum(np.hypot(np.diff(self.x), np.diff(self.top))))
        thick = self.top - base(self.x)
        fat = np.clip(thick - SKIN_MM - LEAST_MUSCLE_MM, 0.5, FAT_MM)
        border = np.array([0 * thick, SKIN_MM + 0 * thick, SKIN_MM + fat, thick])
        row_of = np.append(0, np.cumsum(ROWS))
        z = [self.top - [np.interp(j / 2, row_of, border[:, i]) for i in range(len(self.x))] for j in range(2 * rows + 1)]
        used = np.ones((2 * rows + 1, len(self.x)), bool)
        used[1::2, 1::2] = False
        self.nodes = np.where(used, np.cumsum(used).reshape(used.shape) - 1, -1)
        self.count = used.sum()
        self.place = np.stack([np.broadcast_to(self.x, used.shape)[used], np.array(z)[used]])
        corner = [(self.nodes[j:j + 3, i:i + 3], j // 2) for j in range(0, 2 * rows, 2) for i in range(0, 2 * self.columns, 2)]
        elements = np.array([[n[2, 0], n[2, 2], n[0, 2], n[0, 0], n[2, 1], n[1, 2], n[0, 1], n[1, 0]] for n, _ in corner])
        layer = np.searchsorted(row_of, [j for _, j in corner], side="right") - 1
        held = np.concatenate([self.nodes[-1], self.nodes[:, 0], self.nodes[:, -1]])
        free = np.ones(self.count, bool)
        free[held[held >= 0]] = False
        self.free = np.flatnonzero(np.repeat(free, 3))
        self.assemble(elements, layer)

    def assemble(self, elements, layer):
        """The stiffness of term k is S0 + k S1 + k^2 S2, of motion (u cos, v sin, w cos) k y."""
        material = np.array([elastic(e) for e in YOUNG_KPA])[layer]
        parts = [np.zeros((len(elements), 24, 24)) for _ in range(3)]
        for xi in (-1 / 3 ** 0.5, 1 / 3 ** 0.5):
            for eta in (-1 / 3 ** 0.5, 1 / 3 ** 0.5):
                value, by_xi, by_eta = shape(xi, eta)
                x, z = self.place[0][elements], self.place[1][elements]
                jac = np.array([[x @ by_xi, z @ by_xi], [x @ by_eta, z @ by_eta]])
                det = jac[0, 0] * jac[1, 1] - jac[0, 1] * jac[1, 0]
                by_x = (np.outer(jac[1, 1], by_xi) - np.outer(jac[0, 1], by_eta)) / det[:, None]
                by_z = (np.outer(jac[0, 0], by_eta) - np.outer(jac[1, 0], by_xi)) / det[:, None]
                plane, wave = np.zeros((len(elements), 6, 24)), np.zeros((len(elements), 6, 24))
                for row, dof, of in ((0, 0, by_x), (2, 2, by_z), (3, 1, by_x), (4, 1, by_z), (5, 0, by_z), (5, 2, by_x)):
                    plane[:, row, dof::3] = of
                for row, dof, sign in ((1, 1, 1), (3, 0, -1), (4, 2, -1)):
                    wave[:, row, dof::3] = sign * value
                for part, left, right in ((0, plane, plane), (1, plane, wave), (1, wave, plane), (2, wave, wave)):
                    parts[part] += det[:, None, None] * (left.transpose(0, 2, 1) @ material @ right)
        dofs = (3 * elements[:, :, None] + np.arange(3)).reshape(len(elements), 24)
        at = (np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel())
        size = (3 * self.count, 3 * self.count)
        self.parts = [sparse.csc_matrix((p.ravel(), at), shape=size)[self.free][:, self.free] for p in parts]

    def frame(self, x):
        """Tangent along x and normal of the skin."""
        slope = np.interp(x, self.x, np.gradient(self.top, self.x))
        return np.array([1.0, 0.0, slope]) / np.hypot(1, slope), np.array([-slope, 0.0, 1.0]) / np.hypot(1, slope)

    def solve(self, places, radius, line_load, direction, along_y):
        """Terms of the motion of the skin's nodes: [term, node, axis, load]. line_load(k, half chord, term 0 or not)."""
        points, weights = np.polynomial.legendre.leggauss(12)
        terms = []
        for n in range(TERMS):
            k = 2 * np.pi * n / PERIOD_MM
            # A drag along y is (u sin, v cos, w sin): the same with -k.
            system = (self.parts[0] + (-k if along_y else k) * self.parts[1] + k * k * self.parts[2]).tocsc()
            load = np.zeros((3 * self.count, len(places)))
            for c, x in enumerate(places):
                middle = np.interp(x, self.x, self.arc)
                for i in range(0, 2 * self.columns, 2):
                    low, high = max(self.arc[i], middle - radius), min(self.arc[i + 2], middle + radius)
                    if low >= high:
                        continue
                    for p, w in zip(points, weights):
                        s = 0.5 * (low + high) + 0.5 * (high - low) * p
                        t = 2 * np.interp(s, self.arc[i:i + 3], (0, 0.5, 1)) - 1
                        share = np.array([0.5 * t * (t - 1), 1 - t * t, 0.5 * t * (t + 1)])
                        amount = w * 0.5 * (high - low) * line_load(k, np.sqrt(max(radius ** 2 - (s - middle) ** 2, 0)))
                        for axis in range(3):
                            load[3 * self.nodes[0, i:i + 3] + axis, c] += direction(x)[axis] * share * amount * (1 if n else 0.5)
            motion = np.zeros_like(load)
            solver = linear.splu(system, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
            motion[self.free] = solver.solve(load[self.free])
            terms.append(motion.reshape(self.count, 3, len(places))[self.nodes[0]])
        return np.array(terms)

    def motion(self, terms, load, x, y, along_y):
        k = 2 * np.pi * np.arange(TERMS) / PERIOD_MM
        at = np.array([[np.interp(x, self.x, term[:, axis, load]) for axis in range(3)] for term in terms])
        even, odd = np.cos(np.outer(k, y)), np.sin(np.outer(k, y))
        waves = (odd, even, odd) if along_y else (even, odd, even)
        return np.stack([(at[:, axis] * waves[axis]).sum(0) for axis in range(3)], 1)

    def radii(self, terms, load, x, way, along_y, shares, longest):
        """A row of radii (one a direction) for each share of the motion in the middle."""
        tangent, _ = self.frame(x)
        r = np.arange(0, longest, 0.5)
        ahead = (self.x - x) * tangent[0] + (self.top - np.interp(x, self.x, self.top)) * tangent[2]
        order = np.argsort(ahead)
        rows = [[] for _ in shares]
        middle = self.motion(terms, load, np.array([float(x)]), np.zeros(1), along_y)[0] @ way
        for degree in np.radians(DEGREES):
            places = np.interp(np.cos(degree) * r, ahead[order], self.x[order])
            moved = self.motion(terms, load, places, np.sin(degree) * r, along_y) @ way / middle
            for row, share in zip(rows, shares):
                i = np.argmax(moved < share)
                row.append(round(r[i - 1] + 0.5 * (moved[i - 1] - share) / (moved[i - 1] - moved[i]), 2))
        return rows


def press_line(k, chord):
    return np.pi * (chord * chord / 2 if k * chord < 1e-6 else chord * j1(k * chord) / k)


def drag_line(k, chord):
    return 2 * chord if k == 0 else 2 * np.sin(k * chord) / k


def contours(skin, base, places):
    block = Block(skin, base)
    found = [{"x": x} for x in places]
    terms = block.solve(places, PRESS_MM, press_line, lambda x: -block.frame(x)[1], False)
    for i, x in enumerate(places):
        found[i]["press_tenth"], found[i]["press_quarter"] = block.radii(
            terms, i, x, -block.frame(x)[1], False, (0.1, 0.25), 60)
    for name, along_y in (("drag_x_tenth", False), ("drag_y_tenth", True)):
        way = (lambda x: np.array([0.0, 1.0, 0.0])) if along_y else (lambda x: block.frame(x)[0])
        terms = block.solve(places, DRAG_MM, drag_line, way, along_y)
        for i, x in enumerate(places):
            found[i][name], = block.radii(terms, i, x, way(x), along_y, (0.1,), 100)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-o", required=True)
    x = np.arange(-100.0, 101.0)
    flat = [{"thickness": t} | contours(level(0), level(-t), (0,))[0] for t in FLAT_MM]
    cases = []
    for name, (skin, base, places) in CASES.items():
        cases.append({"name": name, "skin_mm": skin(x).round(3).tolist(), "base_mm": base(x).round(3).tolist(),
                      "loads": contours(skin, base, places)})
        print(name, flush=True)
    note = ("made by tools/solve_uneven_bone.py, which says how; mm; skin_mm and base_mm: heights at x = -100, -99, ... 100, "
            "the same for every y; radii at degrees_from_x")
    with open(parser.parse_args().o, "w", encoding="utf-8") as file:
        file.write("{" + f'"note": {json.dumps(note)},\n"degrees_from_x": {json.dumps(DEGREES.tolist())},\n"flat": [\n')
        file.write(",\n".join(json.dumps(f) for f in flat) + '\n],\n"cases": [\n')
        file.write(",\n".join(json.dumps(c) for c in cases) + "\n]}\n")


if __name__ == "__main__":
    main()
