"""Textures of leaves: an atlas of leaf clusters and a strip of forest edge, with alpha; top row first, sRGB values."""
import numpy as np

# 4 x 2 tiles of 256 px, numbered from the top left.
LEAF_TILE = {"broad": 0, "broad_dark": 1, "birch": 2, "bush": 3, "spruce": 4, "spruce_dark": 5, "grass": 6, "reed": 7}


def leaf_uv(name, inset=0.01):
    column, row = LEAF_TILE[name] % 4, LEAF_TILE[name] // 4
    return column / 4 + inset / 4, 1 - (row + 1) / 2 + inset / 2, (column + 1) / 4 - inset / 4, 1 - row / 2 - inset / 2


def _splat(canvas, x, y, length, width, angle, colour):
    """Draws one leaf (a pointed ellipse with a lit side) over what lies there."""
    n, m = canvas.shape[:2]
    reach = int(length / 2 + 2)
    x0, x1, y0, y1 = int(max(x - reach, 0)), int(min(x + reach, m)), int(max(y - reach, 0)), int(min(y + reach, n))
    if x0 >= x1 or y0 >= y1:
        return
    py, px = np.mgrid[y0:y1, x0:x1]
    u = ((px + 0.5 - x) * np.cos(angle) + (py + 0.5 - y) * np.sin(angle)) / (length / 2)
    v = (-(px + 0.5 - x) * np.sin(angle) + (py + 0.5 - y) * np.cos(angle)) / (width / 2)
    inside = (np.abs(v) < 1 - u * u) & (np.abs(u) < 1)
    shade = 1.0 + 0.12 * np.sign(v) - 0.05 * u
    canvas[y0:y1, x0:x1, :3][inside] = np.clip(np.asarray(colour) * shade[..., None], 0, 1)[inside]
    canvas[y0:y1, x0:x1, 3][inside] = 1.0


def _spread_colour(canvas, rounds=24):
    """Lets colour run into the empty part, so that filtering never mixes in black."""
    filled = canvas[..., 3] > 0
    canvas[~filled, :3] = canvas[filled, :3].mean(axis=0)
    for _ in range(rounds):
        blurred = sum(np.roll(canvas[..., :3], shift, axis) for shift in (-1, 1) for axis in (0, 1)) / 4
        canvas[~filled, :3] = blurred[~filled]
    return canvas


def _cluster(colour, twigs, length, seed, reach=0.47):
    """A branch end: twigs from the middle outwards with leaves on both sides; dark ones behind, light ones in front."""
    rng = np.random.default_rng(seed)
    canvas = np.zeros((256, 256, 4))
    for k in range(twigs):
        front = k / twigs
        a = k * 2.39996 + rng.normal(0, 0.25)
        long, bend = 256 * reach * rng.uniform(0.55, 1.0) * (1.0 - 0.45 * front), rng.normal(0, 0.35)
        for t in np.arange(0.0, 1.0, 0.42 * length / long):
            angle = a + bend * t
            for side in (-0.9, 0.9):
                out = angle + side + rng.normal(0, 0.35)
                size = length * rng.uniform(0.7, 1.25)
                light = (0.52 + 0.5 * front) * rng.uniform(0.82, 1.15) * (1.0 - 0.12 * np.sin(angle) * t)
                hue = np.array([1 + 0.2 * (rng.random() - 0.4), 1.0, 1 - 0.25 * (rng.random() - 0.5)])
                _splat(canvas, 128 + t * long * np.cos(angle) + 0.4 * size * np.cos(out), 128 + t * long * np.sin(angle) + 0.4 * size * np.sin(out),
                       size, 0.56 * size, out, np.array(colour) * light * hue)
    return _spread_colour(canvas)


def _spruce(colour, seed):
    """A bough like a fern: side twigs, dense with needles, shorter towards the tip; its foot at the left edge's middle."""
    rng = np.random.default_rng(seed)
    canvas = np.zeros((256, 256, 4))
    for k in range(64):
        t = 0.98 * (1 - k / 64)
        side = 1 if k % 2 else -1
        long = (1 - 0.8 * t) * 105 * rng.uniform(0.75, 1.1) * min(1.0, 0.35 + 4 * t)
        lean = side * rng.uniform(0.75, 1.15)
        light = rng.uniform(0.6, 1.1)
        for step in np.arange(0, 1, 5.0 / max(long, 6)):
            x, y = 6 + 226 * t + step * long * np.cos(lean), 128 + step * long * np.sin(lean)
            for needle in (-0.75, 0.75):
                shade = light * rng.uniform(0.8, 1.15) * (0.8 + 0.3 * step)
                _splat(canvas, x, y, 20, 5.0, lean + needle, np.array(colour) * shade)
    return _spread_colour(canvas)


def _blades(colour, count, seed, width):
    """Grass blades from the lower edge upwards."""
    rng = np.random.default_rng(seed)
    canvas = np.zeros((256, 256, 4))
    for k in range(count):
        x, top, bend = 16 + 224 * rng.random(), 60 + 180 * rng.random() ** 0.7, rng.normal(0, 45)
        light = (0.6 + 0.5 * k / count) * (0.85 + 0.3 * rng.random())
        for t in np.linspace(0, 1, 90):
            half = width * (1 - 0.85 * t)
            row, at = int(255 - top * t), x + bend * t * t
            left, right = int(np.clip(at - half, 0, 255)), int(np.clip(at + half + 1, 1, 256))
            canvas[max(row - 2, 0):row + 1, left:right, :3] = np.array(colour) * light * (0.65 + 0.4 * t)
            canvas[max(row - 2, 0):row + 1, left:right, 3] = 1
    return _spread_colour(canvas)


def leaves():
    tiles = {"broad": _cluster((0.45, 0.52, 0.27), 34, 24, 1), "broad_dark": _cluster((0.30, 0.36, 0.19), 34, 24, 2),
             "birch": _cluster((0.53, 0.56, 0.30), 30, 18, 3), "bush": _cluster((0.42, 0.48, 0.28), 60, 20, 4, 0.48),
             "spruce": _spruce((0.31, 0.38, 0.285), 5), "spruce_dark": _spruce((0.22, 0.285, 0.22), 6),
             "grass": _blades((0.48, 0.53, 0.31), 120, 7, 2.6), "reed": _blades((0.52, 0.485, 0.31), 80, 8, 2.2)}
    out = np.zeros((512, 1024, 4))
    for name, index in LEAF_TILE.items():
        row, column = index // 4 * 256, index % 4 * 256
        out[row:row + 256, column:column + 256] = np.clip(tiles[name], 0, 1)
    return out


def forest():
    """A forest's edge, 4 units wide and 1 high, tiling sideways: crowns from the back forward, dark at the foot."""
    rng = np.random.default_rng(9)
    h, w = 256, 1024
    canvas = np.zeros((h, w, 4))
    for layer in range(4):
        for x in np.arange(0, w, 40 + 8 * layer):
            _forest_tree(canvas, rng, x + rng.uniform(-16, 16), layer)
    canvas[h - 70:, :, :3] *= np.linspace(1, 0.62, 70)[:, None, None]
    bare = canvas[h - 90:, :, 3] == 0
    canvas[h - 90:][bare] = (0.17, 0.185, 0.135, 1.0)
    return np.clip(_spread_colour(canvas), 0, 1)


def _forest_tree(canvas, rng, x, layer):
    """One tree: tufts over its outline, each lit from above; drawn again one width on where it crosses the edge."""
    h, w = canvas.shape[:2]
    spruce = rng.random() < 0.3
    top = rng.uniform(10, 46) + 30 * layer
    tones = ((0.28, 0.35, 0.265), (0.42, 0.485, 0.275), (0.375, 0.445, 0.255), (0.465, 0.49, 0.28))
    colour = np.array(tones[0 if spruce else rng.integers(1, 4)]) * (0.80 + 0.09 * layer)
    half = rng.uniform(15, 20) if spruce else rng.uniform(26, 40)
    for k in range(42):
        t = k / 42
        reach = half * (0.12 + 0.88 * t) if spruce else half * np.sqrt(np.clip(1 - (1 - 2.0 * t) ** 2, 0.05, 1)) if t < 0.5 else half
        cx, cy = x + rng.uniform(-1, 1) * reach, top + (h - top) * 0.8 * t + rng.normal(0, 4)
        tone = rng.uniform(0.78, 1.12) * (1.1 - 0.4 * t)
        for _ in range(16):
            a, r = rng.random() * 6.283, rng.random() ** 0.5 * (9 if spruce else 12)
            dx, dy = r * np.cos(a), r * np.sin(a) * 0.8
            light = tone * (1.0 - 0.028 * dy) * rng.uniform(0.85, 1.15)
            for shift in (0, w if cx < 60 else -w if cx > w - 60 else 0):
                _splat(canvas, cx + dx + shift, cy + dy, 7.0, 4.4, a + 1.5, colour * light)
