#!/usr/bin/python3
"""Draws triangle meshes into a PNG picture, for documentation and for a look at what was built.

    tools/draw_mesh.py back.ply -o back.png
    tools/draw_mesh.py skin.ply@skin@0.35 bones.ply@bone -o torso.png --view back --view oblique --view side
    tools/draw_mesh.py torso.ply -o depth.png --scalar depth_mm --range 0 60

Each mesh is FILE[@COLOUR[@ALPHA]] (OBJ, STL or PLY; COLOUR is skin, bone, grey or RRGGBB). Needs Python 3 and numpy only.
A software z-buffer with smooth shading: no window, no graphics card, the same picture everywhere.
"""
import argparse
import struct
import sys
import zlib

import numpy as np

COLOURS = {"skin": (0.89, 0.68, 0.55), "bone": (0.88, 0.85, 0.75), "grey": (0.75, 0.75, 0.75)}
BACKGROUND = (0.15, 0.17, 0.20)
# Azimuth about the cranial axis and elevation in degrees; 0, 0 looks at the back, from behind.
VIEWS = {"back": (0, 0), "oblique": (35, 8), "oblique-left": (-35, 8), "side": (90, 0), "front": (180, 0), "top": (0, 80)}
KEY_LIGHT = (-0.55, 0.50, 0.67)
SUPERSAMPLE = 2


# ---------------------------------------------------------------- reading

def read_obj(path):
    points, triangles = [], []
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            words = line.split()
            if words and words[0] == "v":
                points.append([float(w) for w in words[1:4]])
            elif words and words[0] == "f":
                corners = [int(w.split("/")[0]) for w in words[1:]]
                corners = [c - 1 if c > 0 else c + len(points) for c in corners]
                triangles += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]
    return np.array(points), np.array(triangles), {}


def read_stl(path):
    data = open(path, "rb").read()
    count = struct.unpack("<I", data[80:84])[0]
    record = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
    corners = np.frombuffer(data, record, count, 84)["corners"].reshape(-1, 3)
    points, triangles = np.unique(corners, axis=0, return_inverse=True)
    return points.astype(float), triangles.reshape(-1, 3), {}


PLY_TYPES = {"char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2",
             "uint16": "u2", "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "float": "f4", "float32": "f4",
             "double": "f8", "float64": "f8"}


def read_ply(path):
    data = open(path, "rb").read()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    elements, ascii_format, order = [], False, "<"
    for line in data[:end].decode("ascii").splitlines():
        words = line.split()
        if words[0] == "format":
            ascii_format, order = words[1] == "ascii", ">" if "big" in words[1] else "<"
        elif words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    read = read_ply_ascii if ascii_format else read_ply_binary
    return read(data[end:], elements, order)


def read_ply_ascii(body, elements, _):
    lines = iter(body.decode("ascii").splitlines())
    points, triangles, scalars = None, [], {}
    for name, count, properties in elements:
        rows = [next(lines).split() for _ in range(count)]
        if name == "vertex":
            table = np.array(rows, float)
            points, scalars = split_vertices(table.T, [p[-1] for p in properties])
        elif name == "face":
            triangles = [[int(r[1]), int(r[i]), int(r[i + 1])] for r in rows for i in range(2, int(r[0]))]
    return points, np.array(triangles), scalars


def read_ply_binary(body, elements, order):
    points, triangles, scalars, at = None, None, {}, 0
    for name, count, properties in elements:
        if name == "face":
            kinds = properties[0]
            record = np.dtype([("n", order + PLY_TYPES[kinds[1]]), ("corners", order + PLY_TYPES[kinds[2]], 3)] +
                              [(p[-1], order + PLY_TYPES[p[0]]) for p in properties[1:]])
            triangles = np.frombuffer(body, record, count, at)["corners"].astype(np.int64)
        else:
            record = np.dtype([(p[-1], order + PLY_TYPES[p[0]]) for p in properties])
            rows = np.frombuffer(body, record, count, at)
            if name == "vertex":
                points, scalars = split_vertices([rows[n].astype(float) for n in record.names], record.names)
        at += count * record.itemsize
    return points, triangles, scalars


def split_vertices(columns, names):
    table = dict(zip(names, columns))
    return np.stack([table.pop(axis) for axis in "xyz"], 1), table


def read_mesh(path):
    readers = {"obj": read_obj, "stl": read_stl, "ply": read_ply}
    extension = path.rsplit(".", 1)[-1].lower()
    if extension not in readers:
        sys.exit(f"draw_mesh: {path}: not an .obj, .stl or .ply file")
    return readers[extension](path)


# ---------------------------------------------------------------- drawing

def vertex_normals(points, triangles):
    corners = points[triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(points)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], area)
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)


def rotation(view):
    azimuth, elevation = np.radians(VIEWS[view] if view in VIEWS else [float(w) for w in view.split(",")])
    ca, sa, ce, se = np.cos(azimuth), np.sin(azimuth), np.cos(elevation), np.sin(elevation)
    turn = np.array([[ca, 0, -sa], [0, 1, 0], [sa, 0, ca]])
    nod = np.array([[1, 0, 0], [0, ce, -se], [0, se, ce]])
    return nod @ turn


def fragments(screen, triangles, width, height):
    """Pixels covered by the triangles, in batches: (triangle, pixel, barycentric weights)."""
    corners = screen[triangles]
    low = np.maximum(np.ceil(corners[:, :, :2].min(1)).astype(int), 0)
    high = np.minimum(np.floor(corners[:, :, :2].max(1)).astype(int), [width - 1, height - 1])
    extent = (high - low).max(1) + 1
    limit = 1
    while (extent >= limit).any():
        chosen = np.flatnonzero((extent >= limit) & (extent < 2 * limit) & (high >= low).all(1))
        # A batch evaluates every pixel of the box of its triangles at once; its size bounds the memory.
        step = max(1, 4_000_000 // (4 * limit * limit))
        for start in range(0, len(chosen), step):
            yield covered(chosen[start:start + step], corners, low, high, 2 * limit, width)
        limit *= 2


def covered(chosen, corners, low, high, size, width):
    offset = np.stack(np.meshgrid(np.arange(size), np.arange(size)), -1).reshape(-1, 2)
    pixel = low[chosen][:, None] + offset
    a, b, c = (corners[chosen, i, :2][:, None] for i in range(3))
    cross = lambda u, v: u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]
    area = cross(b - a, c - a)
    with np.errstate(divide="ignore", invalid="ignore"):
        weights = np.stack([cross(b - pixel, c - pixel), cross(c - pixel, a - pixel), cross(a - pixel, b - pixel)],
                           -1) / area[..., None]
    inside = (weights >= -1e-9).all(-1) & (pixel <= high[chosen][:, None]).all(-1)
    row, column = np.nonzero(inside)
    at = pixel[row, column]
    return chosen[row], at[:, 1] * width + at[:, 0], weights[row, column]


def rasterise(screen, triangles, width, height):
    """Nearest triangle of each pixel: depth (larger is nearer), triangle index (-1 none), barycentric weights."""
    depth = np.full(width * height, -np.inf)
    nearest = np.full(width * height, -1)
    weight = np.zeros((width * height, 3))
    for triangle, pixel, weights in fragments(screen, triangles, width, height):
        z = (screen[triangles[triangle], 2] * weights).sum(1)
        np.maximum.at(depth, pixel, z)
        top = z >= depth[pixel]
        nearest[pixel[top]], weight[pixel[top]] = triangle[top], weights[top]
    return depth, nearest, weight


def colour_map(value):
    """Blue - white - red for value in [0, 1]."""
    value = np.clip(value, 0, 1)[:, None]
    blue, white, red = (np.array(c) for c in ((0.15, 0.30, 0.75), (0.95, 0.95, 0.92), (0.80, 0.15, 0.12)))
    return np.where(value < 0.5, blue + (white - blue) * 2 * value, white + (red - white) * (2 * value - 1))


def shade(normals, colours):
    key = np.array(KEY_LIGHT) / np.linalg.norm(KEY_LIGHT)
    diffuse = np.clip(normals @ key, 0, 1)
    half = key + [0, 0, 1]
    shine = np.clip(normals @ (half / np.linalg.norm(half)), 0, 1) ** 40
    return colours * (0.22 + 0.78 * diffuse)[:, None] + 0.06 * shine[:, None]


def draw_layer(mesh, turn, place, width, height, options):
    points, triangles, scalars, colour, _ = mesh
    screen = place(points @ turn.T)
    depth, nearest, weight = rasterise(screen, triangles, width, height)
    seen = np.flatnonzero(nearest >= 0)
    corner = triangles[nearest[seen]]
    blend = lambda values: (values[corner] * weight[seen][:, :, None]).sum(1)
    normals = blend(vertex_normals(points, triangles) @ turn.T)
    # A sheet seen from behind is lit as from its front; a smooth normal that turns away at a silhouette is kept.
    away = np.cross(screen[corner[:, 1]] - screen[corner[:, 0]], screen[corner[:, 2]] - screen[corner[:, 0]])[:, 2] > 0
    normals[away] *= -1
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    base = np.tile(np.array(colour, float), (len(seen), 1))
    if options.scalar in scalars:
        low, high = options.range or (scalars[options.scalar].min(), scalars[options.scalar].max())
        base = colour_map((blend(scalars[options.scalar][:, None])[:, 0] - low) / max(high - low, 1e-30))
    if options.wire:
        edge = weight[seen].min(1) < 0.035
        base[edge] *= 0.35
    return depth, seen, shade(normals, base)


def draw_view(meshes, view, options):
    width, height = options.size[0] * SUPERSAMPLE, options.size[1] * SUPERSAMPLE
    turn = rotation(view)
    everything = np.concatenate([m[0] for m in meshes])
    centre = (everything.min(0) + everything.max(0)) / 2
    extent = np.linalg.norm((everything - centre) * [1, 0, 1], axis=1).max() * 2, np.ptp(everything[:, 1])
    scale = options.zoom * 0.94 * min(width / extent[0], height / max(extent[1], 1e-9))
    flip = np.array([scale, -scale, scale])
    middle = np.array([width / 2, height / 2, 0])
    place = lambda turned: (turned - turn @ centre) * flip + middle
    image = np.tile(np.array(BACKGROUND), (width * height, 1))
    front = np.full(width * height, -np.inf)
    for mesh in sorted(meshes, key=lambda m: -m[4]):  # what is opaque first
        depth, seen, colours = draw_layer(mesh, turn, place, width, height, options)
        visible = depth[seen] > front[seen]
        seen, colours, alpha = seen[visible], colours[visible], mesh[4]
        image[seen] = alpha * colours + (1 - alpha) * image[seen]
        if alpha >= 1:
            front[seen] = depth[seen]
    image = image.reshape(options.size[1], SUPERSAMPLE, options.size[0], SUPERSAMPLE, 3).mean((1, 3))
    return (np.clip(image, 0, 1) * 255 + 0.5).astype(np.uint8)


# ---------------------------------------------------------------- writing

def write_png(path, image):
    height, width, _ = image.shape
    # Filter "up": neighbouring rows are alike, which halves the file.
    difference = np.diff(image.reshape(height, -1), axis=0, prepend=np.zeros((1, width * 3), np.uint8))
    rows = np.concatenate([np.full((height, 1), 2, np.uint8), difference.astype(np.uint8)], 1)
    chunk = lambda tag, body: struct.pack(">I", len(body)) + tag + body + struct.pack(">I", zlib.crc32(tag + body))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(rows.tobytes(), 9)) + chunk(b"IEND", b""))


def parse_mesh(text):
    path, colour, alpha = (text.split("@") + ["", ""])[:3]
    points, triangles, scalars = read_mesh(path)
    if colour in COLOURS or not colour:
        rgb = COLOURS[colour or "skin"]
    else:
        rgb = tuple(int(colour[i:i + 2], 16) / 255 for i in (0, 2, 4))
    return points, triangles, scalars, rgb, float(alpha or 1)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", metavar="FILE[@COLOUR[@ALPHA]]")
    parser.add_argument("-o", "--output", required=True, help="PNG file to write")
    parser.add_argument("--view", action="append", help=f"{', '.join(VIEWS)} or AZIMUTH,ELEVATION in degrees; repeatable")
    parser.add_argument("--size", nargs=2, type=int, default=(500, 560), help="pixels of one view (500 560)")
    parser.add_argument("--zoom", type=float, default=1.0)
    parser.add_argument("--scalar", help="colour by this vertex property of a PLY, blue to red")
    parser.add_argument("--range", nargs=2, type=float, help="scalar values of blue and red")
    parser.add_argument("--wire", action="store_true", help="draw the edges of the triangles")
    parser.add_argument("--separate", action="store_true", help="one column of views for each mesh, not one picture of all")
    options = parser.parse_args()
    meshes = [parse_mesh(text) for text in options.meshes]
    groups = [[m] for m in meshes] if options.separate else [meshes]
    rows = [np.concatenate([draw_view(g, view, options) for g in groups], 1) for view in options.view or ["back"]]
    write_png(options.output, np.concatenate(rows, 0 if options.separate else 1))


if __name__ == "__main__":
    main()
