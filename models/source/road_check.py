"""Checks a road model with nothing but Python: python3 models/source/road_check.py models/road.glb

Size and triangles, the convention's extras, every shelter convex, the route inside each shelter that it must pass through and
outside all of them elsewhere, no gap between the tunnel's pieces. Exit code 1 when something does not hold.
"""
import json
import math
import struct
import sys

MAX_BYTES, MAX_TRIANGLES, MAX_LIGHTS = 6_000_000, 250_000, 40
CONVEX_TOLERANCE_M = 2e-3  # rounding of 32-bit floats two kilometres from the origin
HEADROOM_M = 1.2           # the driver's eye above the route


def read(path):
    blob = open(path, "rb").read()
    length = struct.unpack_from("<I", blob, 12)[0]
    return json.loads(blob[20:20 + length]), blob[20 + length + 8:], len(blob)


def accessor(doc, data, index):
    a = doc["accessors"][index]
    view = doc["bufferViews"][a["bufferView"]]
    kind = {5126: "f", 5125: "I", 5123: "H", 5121: "B"}[a["componentType"]]
    width = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[a["type"]]
    start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
    flat = struct.unpack_from(f"<{a['count'] * width}{kind}", data, start)
    return flat if width == 1 else [flat[i:i + width] for i in range(0, len(flat), width)]


def transform(node, p):
    sx, sy, sz = node.get("scale", (1, 1, 1))
    p = (p[0] * sx, p[1] * sy, p[2] * sz)
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    t = (2 * (y * p[2] - z * p[1]), 2 * (z * p[0] - x * p[2]), 2 * (x * p[1] - y * p[0]))
    p = (p[0] + w * t[0] + y * t[2] - z * t[1], p[1] + w * t[1] + z * t[0] - x * t[2], p[2] + w * t[2] + x * t[1] - y * t[0])
    return tuple(a + b for a, b in zip(p, node.get("translation", (0, 0, 0))))


def planes(doc, data, node):
    """Outward planes (normal, offset) of a node's faces, and its corners."""
    out, corners = [], []
    for primitive in doc["meshes"][node["mesh"]]["primitives"]:
        points = [transform(node, p) for p in accessor(doc, data, primitive["attributes"]["POSITION"])]
        corners += points
        index = accessor(doc, data, primitive["indices"])
        for i in range(0, len(index), 3):
            a, b, c = (points[k] for k in index[i:i + 3])
            u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
            n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            size = math.sqrt(sum(k * k for k in n))
            if size > 1e-9:
                n = tuple(k / size for k in n)
                out.append((n, sum(p * q for p, q in zip(n, a))))
    return out, corners


def inside(shell, p):
    return all(sum(a * b for a, b in zip(n, p)) <= offset for n, offset in shell)


def covered(route, shells):
    """Stretches (from, to, names) of the route, sampled every 0.1 m at eye height, that lie in shelters."""
    runs, arc, prefix = [], 0.0, None
    for a, b in zip(route[:-1], route[1:]):
        step = math.dist(a, b)
        for k in range(int(step / 0.1)):
            p = [u + (v - u) * k * 0.1 / step for u, v in zip(a, b)]
            p[1] += HEADROOM_M
            names = [name.split("_")[0] for name, shell in shells if inside(shell, p)]
            now = names[0] if names else None
            if now != prefix:
                runs.append([arc + k * 0.1, arc + k * 0.1, now])
            if runs:
                runs[-1][1] = arc + k * 0.1
            prefix = now
        arc += step
    return [run for run in runs if run[2]], arc


def main(path):
    doc, data, size = read(path)
    faults = []
    extras = [(n, n["extras"]["rainglass"]) for n in doc["nodes"] if "rainglass" in n.get("extras", {})]
    triangles = lambda m: sum(doc["accessors"][p["indices"]]["count"] // 3 for p in doc["meshes"][m]["primitives"])
    drawn = sum(triangles(n["mesh"]) for n in doc["nodes"] if "mesh" in n and n.get("extras", {}).get("rainglass", {}).get("type") != "shelter")
    stored = sum(triangles(m) for m in range(len(doc["meshes"])))
    images = sum(doc["bufferViews"][i["bufferView"]]["byteLength"] for i in doc["images"])
    lights = [n for n, e in extras if e["type"] == "light"]
    print(f"{size / 1e6:.2f} MB, textures {images / 1e6:.2f} MB in {len(doc['images'])}, triangles {drawn} drawn, {stored} stored, "
          f"{len(doc['nodes'])} nodes, {len(doc['meshes'])} meshes, {len(doc['materials'])} materials, {len(lights)} lights")
    print("extensions:", doc.get("extensionsUsed", []))
    faults += ["file too large"] * (size > MAX_BYTES) + ["too many triangles"] * (drawn > MAX_TRIANGLES) + ["too many lights"] * (len(lights) > MAX_LIGHTS)
    faults += [f"light without lamp: {n['name']}" for n in lights if "KHR_lights_punctual" not in n.get("extensions", {})]
    faults += [f"unexpected extension {e}" for e in doc.get("extensionsUsed", []) if e != "KHR_lights_punctual"]
    shells = []
    for node, extra in extras:
        if extra["type"] == "shelter":
            shell, corners = planes(doc, data, node)
            worst = max(sum(a * b for a, b in zip(n, p)) - offset for n, offset in shell for p in corners)
            faults += [f"{extra['name']} is not convex by {worst:.4f} m"] * (worst > CONVEX_TOLERANCE_M)
            shells.append((extra["name"], shell))
    routes = [(n, e) for n, e in extras if e["type"] == "route"]
    if len(routes) != 1:
        return faults + ["not exactly one route"]
    flat = routes[0][1]["points_m"]
    line = [flat[i:i + 3] for i in range(0, len(flat), 3)]
    steps = [math.dist(a, b) for a, b in zip(line[:-1], line[1:])]
    runs, arc = covered(line, shells)
    print(f"route: {len(line)} points {min(steps):.2f}..{max(steps):.2f} m apart, {arc:.1f} m; smallest radius {radius(line):.1f} m")
    for first, last, name in runs:
        print(f"  {first:7.1f} .. {last:7.1f} m  {name}")
    faults += [f"route is under {[r[2] for r in runs]}, not bridge, tunnel, canopy once each"] * ([r[2] for r in runs] != ["bridge", "tunnel", "canopy"])
    faults += ["route shorter than 1.6 km"] * (arc < 1600)
    return faults


def radius(line):
    """Smallest radius of a circle through three neighbouring points."""
    best = math.inf
    for a, b, c in zip(line[:-2], line[1:-1], line[2:]):
        ab, bc, ca = math.dist(a, b), math.dist(b, c), math.dist(a, c)
        area = abs((b[0] - a[0]) * (c[2] - a[2]) - (c[0] - a[0]) * (b[2] - a[2])) / 2
        best = min(best, ab * bc * ca / (4 * area)) if area > 1e-6 else best
    return best


if __name__ == "__main__":
    found = main(sys.argv[1])
    print("\n".join("FAULT: " + f for f in found) or "all holds")
    sys.exit(bool(found))
