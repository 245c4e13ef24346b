"""Checks an exported car without Blender. Run: python3 models/source/car_check.py models/car.glb

Looks for the nodes that a car should bring, uv on every pane, faces that are not degenerate, panes' charts that do not overlap,
and unit normals; prints what it counted and leaves with 1 at the first fault.
"""
import json
import math
import struct
import sys

FORMATS = {5121: ("B", 1), 5123: ("H", 2), 5125: ("I", 4), 5126: ("f", 4)}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def load(path):
    data = open(path, "rb").read()
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


def read(doc, blob, index):
    a = doc["accessors"][index]
    view = doc["bufferViews"][a["bufferView"]]
    code, width = FORMATS[a["componentType"]]
    n = WIDTHS[a["type"]]
    start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
    flat = struct.unpack_from(f"<{a['count'] * n}{code}", blob, start)
    return flat if n == 1 else [flat[k:k + n] for k in range(0, len(flat), n)]


def area3(a, b, c):
    u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
    x = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    return 0.5 * math.sqrt(sum(q * q for q in x))


def area2(a, b, c):
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


def check_primitive(doc, blob, primitive, name, pane):
    p = read(doc, blob, primitive["attributes"]["POSITION"])
    n = read(doc, blob, primitive["attributes"]["NORMAL"])
    index = read(doc, blob, primitive["indices"])
    assert max(index) < len(p), f"{name}: index beyond its vertices"
    assert all(math.isfinite(c) for q in p for c in q), f"{name}: a position is not a number"
    assert all(abs(math.hypot(*q) - 1) < 1e-2 for q in n), f"{name}: a normal is not of unit length"
    faces = [index[k:k + 3] for k in range(0, len(index), 3)]
    flat = sum(area3(*(p[i] for i in f)) < 1e-10 for f in faces)
    assert flat <= 0.01 * len(faces), f"{name}: {flat} of {len(faces)} faces have no area"
    if pane:
        uv = read(doc, blob, primitive["attributes"]["TEXCOORD_0"])
        signs = [area2(*(uv[i] for i in f)) for f in faces]
        assert min(signs) > 0 or max(signs) < 0, f"{name}: its chart folds over"
        whole = sum(area3(*(p[i] for i in f)) for f in faces)
        ratios = sorted(math.sqrt(abs(s) / area3(*(p[i] for i in f))) for s, f in zip(signs, faces))
        print(f"  pane {name}: {len(faces)} faces, {whole:.3f} m2, uv per metre {ratios[0]:.3f}..{ratios[-1]:.3f}")
    return len(faces), flat


def main(path):
    doc, blob = load(path)
    said = [(n["name"], n["extras"]["rainglass"]) for n in doc["nodes"] if "rainglass" in n.get("extras", {})]
    kinds = {}
    for _, s in said:
        kinds[s["type"]] = kinds.get(s["type"], 0) + 1
    for kind, least in dict(pane=7, shelter=1, wiper=2, eye=1, camera=3, wheel=4, steering_wheel=1, needle=2, digit=3, mirror=3, light=5).items():
        assert kinds.get(kind, 0) >= least, f"{kind}: {kinds.get(kind, 0)} nodes, expected {least}"
    names = {s["name"] for _, s in said if s["type"] == "pane"}
    assert all(s["pane"] in names for _, s in said if s["type"] == "wiper"), "a wiper names no pane"
    panes = {n["mesh"] for n in doc["nodes"] if n.get("extras", {}).get("rainglass", {}).get("type") == "pane"}
    total = flat = 0
    for k, mesh in enumerate(doc["meshes"]):
        for primitive in mesh["primitives"]:
            f, z = check_primitive(doc, blob, primitive, mesh["name"], k in panes)
            total, flat = total + f * sum(n.get("mesh") == k for n in doc["nodes"]), flat + z
    print(f"{path}: {total} triangles drawn, {flat} without area, {len(doc['nodes'])} nodes, {len(doc.get('images', []))} images, {kinds}")


if __name__ == "__main__":
    try:
        main(sys.argv[1])
    except AssertionError as fault:
        sys.exit(f"{sys.argv[1]}: {fault}")
