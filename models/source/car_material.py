"""The car's materials: metallic-roughness values with albedos of real car stuff, and small textures made by numpy."""
import bpy
import numpy as np

import car_pictures

# name: (base colour linear RGB or texture name, metallic, roughness, extras)
TABLE = {
    "paint": ((0.020, 0.085, 0.21), 0.55, 0.22, {}),
    "black_gloss": ((0.010, 0.010, 0.011), 0.0, 0.10, {}),
    "black_plastic": ((0.036, 0.036, 0.037), 0.0, 0.55, {}),
    "rubber": ((0.016, 0.016, 0.016), 0.0, 0.75, {}),
    "tyre": ((0.022, 0.022, 0.022), 0.0, 0.85, {}),
    "under": ((0.012, 0.012, 0.012), 0.0, 0.95, {}),
    "chrome": ((0.62, 0.62, 0.63), 1.0, 0.12, {}),
    "alloy": ((0.50, 0.51, 0.52), 1.0, 0.32, {}),
    "steel": ((0.32, 0.31, 0.30), 1.0, 0.45, {}),
    "satin": ((0.34, 0.345, 0.35), 1.0, 0.36, {}),
    "frit": ((0.006, 0.006, 0.006), 0.0, 0.35, {"double": True}),
    "glass": ((0.72, 0.90, 0.80), 0.0, 0.0, {"alpha": 0.06}),
    "privacy": ((0.03, 0.045, 0.04), 0.0, 0.0, {"alpha": 0.35}),
    "lens": ((0.80, 0.84, 0.88), 0.0, 0.02, {"alpha": 0.06}),
    "dash": ("grain_dark", 0.0, 0.62, {}),
    "trim": ("grain_mid", 0.0, 0.66, {}),
    "leather": ("leather", 0.0, 0.45, {}),
    "fabric": ("weave", 0.0, 0.90, {}),
    "fabric_side": ("weave_dark", 0.0, 0.85, {}),
    "headliner": ("felt", 0.0, 0.95, {}),
    "carpet": ("carpet", 0.0, 0.98, {}),
    "belt": ((0.020, 0.020, 0.021), 0.0, 0.60, {}),
    "piano": ((0.008, 0.008, 0.009), 0.0, 0.07, {}),
    "dials": ("dials", 0.0, 0.30, {"emissive": "dials"}),
    "digits": ("digits", 0.0, 0.30, {"emissive": "digits"}),
    "needle": ((0.85, 0.12, 0.04), 0.0, 0.30, {"glow": (0.85, 0.12, 0.04)}),
    "screen": ("screen", 0.0, 0.10, {"emissive": "screen"}),
    "mirror": ((0.85, 0.86, 0.86), 1.0, 0.02, {}),
    "plate": ("plate", 0.0, 0.45, {}),
    "reflector": ((0.72, 0.73, 0.74), 1.0, 0.10, {}),
    "head_lamp": ((0.80, 0.80, 0.80), 0.0, 0.20, {"glow": (1.0, 0.96, 0.88)}),
    "tail_lamp": ((0.30, 0.008, 0.006), 0.0, 0.12, {"glow": (0.55, 0.008, 0.005)}),
    "brake_lamp": ((0.34, 0.010, 0.008), 0.0, 0.12, {"glow": (0.9, 0.015, 0.008)}),
    "indicator_lamp": ((0.30, 0.07, 0.012), 0.0, 0.12, {"glow": (0.30, 0.08, 0.01)}),
    "red_lens": ((0.26, 0.006, 0.006), 0.0, 0.06, {}),
}

_made = {}


def material(name):
    if name in _made:
        return _made[name]
    base, metallic, roughness, more = TABLE[name]
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    nodes, links = m.node_tree.nodes, m.node_tree.links
    b = nodes["Principled BSDF"]
    if isinstance(base, str):
        t = nodes.new("ShaderNodeTexImage")
        t.image = texture(base)
        links.new(t.outputs["Color"], b.inputs["Base Color"])
        if "emissive" in more:
            links.new(t.outputs["Color"], b.inputs["Emission"])
    else:
        b.inputs["Base Color"].default_value = (*base, 1.0)
    b.inputs["Metallic"].default_value, b.inputs["Roughness"].default_value = metallic, roughness
    if "glow" in more:
        b.inputs["Emission"].default_value = (*more["glow"], 1.0)
    if "alpha" in more:
        b.inputs["Alpha"].default_value = more["alpha"]
        m.blend_method = "BLEND"
    m.use_backface_culling = "double" not in more
    _made[name] = m
    return m


def texture(name):
    rgb = PICTURES[name]()
    h, w, _ = rgb.shape
    image = bpy.data.images.new(name, w, h)
    srgb = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * np.maximum(rgb, 1e-6)**(1 / 2.4) - 0.055)
    pixels = np.ones((h, w, 4), np.float32)
    pixels[..., :3] = np.clip(srgb, 0, 1)
    image.pixels.foreach_set(pixels.ravel())
    image.pack()
    return image


# --- tiles (box projected, see TILES_PER_M in car_mesh.py) ---

def noise(size, octaves, seed):
    """Periodic value noise in -1..1 with unit variance-ish: random Fourier phases per octave."""
    rng = np.random.default_rng(seed)
    f = np.fft.fftfreq(size) * size
    k = np.hypot(*np.meshgrid(f, f))
    out = np.zeros((size, size))
    for k0, amplitude in octaves:
        band = np.exp(-((k - k0) / (0.35 * k0))**2)
        n = np.real(np.fft.ifft2(np.fft.fft2(rng.standard_normal((size, size))) * band))
        out += amplitude * n / n.std()
    return out


def tinted(base, value):
    return np.clip(np.asarray(base)[None, None] * value[..., None], 0, 1)


def grain(base, seed):
    return tinted(base, 1 + 0.13 * noise(256, [(90, 1.0), (45, 0.5), (3, 0.25)], seed))


def weave(base, seed):
    y, x = np.mgrid[0:256, 0:256] / 256 * 2 * np.pi
    thread = 0.16 * np.sin(64 * x) * np.sin(64 * y) + 0.10 * np.sign(np.sin(32 * (x + y)))
    return tinted(base, 1 + thread + 0.10 * noise(256, [(80, 1), (8, 0.4)], seed))


PICTURES = {
    "grain_dark": lambda: grain((0.056, 0.056, 0.059), 1),
    "grain_mid": lambda: grain((0.095, 0.093, 0.091), 2),
    "leather": lambda: grain((0.045, 0.044, 0.043), 3),
    "weave": lambda: weave((0.105, 0.108, 0.115), 4),
    "weave_dark": lambda: weave((0.062, 0.062, 0.066), 5),
    "felt": lambda: tinted((0.56, 0.55, 0.53), 1 + 0.07 * noise(256, [(100, 1), (30, 0.5)], 6)),
    "carpet": lambda: tinted((0.028, 0.028, 0.030), 1 + 0.30 * noise(256, [(100, 1), (40, 0.5)], 7)),
    "dials": car_pictures.dials,
    "digits": car_pictures.digits,
    "screen": car_pictures.screen,
    "plate": car_pictures.plate,
}
