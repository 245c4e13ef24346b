"""Materials by name. Textures are written as JPEG (PNG where alpha is needed) and taken up by the exporter unchanged."""
import os
import struct
import tempfile
import zlib

import bpy
import numpy as np

import road_foliage
import road_textures

_FOLDER = tempfile.mkdtemp(prefix="road_textures_")
_IMAGES = {}

# name: (texture or None, colour factor, roughness, metallic)
PLAIN = {
    "grass": ("grass", (1, 1, 1), 0.95, 0), "meadow": ("meadow", (1, 1, 1), 0.95, 0), "crop": ("crop", (1, 1, 1), 0.95, 0),
    "soil": ("soil", (1, 1, 1), 0.95, 0), "gravel": ("gravel", (1, 1, 1), 0.95, 0), "paving": ("paving", (1, 1, 1), 0.85, 0),
    "far_woods": ("far_woods", (1, 1, 1), 1.0, 0), "paint": ("paint", (1, 1, 1), 0.6, 0),
    "concrete": ("concrete", (1, 1, 1), 0.85, 0), "concrete_dark": ("concrete", (0.42, 0.42, 0.43), 0.9, 0),
    "asphalt_patch": ("asphalt", (0.62, 0.62, 0.63), 0.8, 0), "asphalt_old": ("asphalt", (1.0, 0.97, 0.93), 0.88, 0),
    "hay": ("crop", (1.0, 0.86, 0.60), 0.95, 0), "concrete_vault": ("concrete", (0.62, 0.61, 0.58), 0.9, 0), "kerb": ("concrete", (0.95, 0.95, 0.95), 0.85, 0), "tiles": ("tiles", (1, 1, 1), 0.45, 0),
    "plaster_white": ("plaster", (0.86, 0.85, 0.80), 0.9, 0), "plaster_ochre": ("plaster", (0.78, 0.62, 0.38), 0.9, 0),
    "plaster_grey": ("plaster", (0.60, 0.62, 0.62), 0.9, 0), "plaster_rose": ("plaster", (0.74, 0.52, 0.42), 0.9, 0),
    "brick": ("brick", (1, 1, 1), 0.9, 0), "roof_red": ("roof", (1, 1, 1), 0.8, 0), "roof_slate": ("roof", (0.42, 0.52, 0.62), 0.7, 0),
    "bark": ("bark", (1, 1, 1), 0.95, 0), "bark_birch": ("bark", (2.0, 2.0, 2.0), 0.9, 0), "wood": ("bark", (0.9, 0.8, 0.7), 0.9, 0),
    "steel": (None, (0.42, 0.44, 0.46), 0.45, 0.7), "steel_dark": (None, (0.09, 0.10, 0.11), 0.5, 0.4),
    "white": (None, (0.72, 0.72, 0.70), 0.5, 0), "black": (None, (0.02, 0.02, 0.02), 0.6, 0), "red": (None, (0.35, 0.02, 0.02), 0.4, 0),
    "car_blue": (None, (0.03, 0.07, 0.16), 0.25, 0.3), "car_red": (None, (0.22, 0.02, 0.02), 0.25, 0.2),
    "car_silver": (None, (0.40, 0.41, 0.42), 0.3, 0.6), "car_glass": (None, (0.02, 0.025, 0.03), 0.08, 0), "tyre": (None, (0.02, 0.02, 0.02), 0.9, 0),
}
# name: texture, both sides drawn. One-sided ones come with both windings where both are seen: each side keeps its normals.
MASKED = {"leaves": ("leaves", True), "leaves_upright": ("leaves", False), "forest": ("forest", False)}
GLOWING = {"lamp_warm": (1.0, 0.80, 0.52), "lamp_white": (1.0, 0.97, 0.90), "exit_green": (0.006, 0.10, 0.03), "tail_red": (0.4, 0.01, 0.01), "canopy_white": (0.035, 0.034, 0.032)}
ALPHA = {"leaves": road_foliage.leaves, "forest": road_foliage.forest}


def _image(name, data=False):
    """A texture by the name of its function; data: not a colour (normals, roughness)."""
    if name in _IMAGES:
        return _IMAGES[name]
    pixels = (ALPHA[name] if name in ALPHA else getattr(road_textures, name))()
    rows, columns, channels = pixels.shape
    full = np.ones((rows, columns, 4), np.float32)
    full[..., :channels] = pixels
    path = os.path.join(_FOLDER, name + (".png" if channels == 4 else ".jpg"))
    (_write_png if channels == 4 else _write_jpeg)(full, path)
    image = bpy.data.images.load(path)
    image.name = name
    image.colorspace_settings.name = "Non-Color" if data else "sRGB"
    _IMAGES[name] = image
    return image


def _write_jpeg(pixels, path, quality=80):
    made = bpy.data.images.new("made", pixels.shape[1], pixels.shape[0])
    made.pixels.foreach_set(pixels[::-1].ravel())
    scene = bpy.context.scene
    scene.view_settings.view_transform = "Standard"
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.quality = "JPEG", "RGB", quality
    made.save_render(path, scene=scene)
    bpy.data.images.remove(made)


def _write_png(pixels, path):
    """Blender's own PNG drops the colour below transparent pixels, which filtering needs. Up-filtered rows, zlib's best."""
    data = np.round(pixels * 255).astype(np.uint8)
    rows, columns = data.shape[:2]
    up = data - np.concatenate([np.zeros_like(data[:1]), data[:-1]])
    lines = np.concatenate([np.full((rows, 1), 2, np.uint8), up.reshape(rows, -1)], axis=1)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n")
        for kind, body in ((b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 6, 0, 0, 0)), (b"IDAT", zlib.compress(lines.tobytes(), 9)), (b"IEND", b"")):
            out.write(struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body)))


def _texture(material, name, data=False):
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = _image(name, data)
    return node


def _start(name, roughness, metallic):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.use_backface_culling = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Metallic"].default_value = metallic
    return material, shader, material.node_tree.links


def _tinted(material, texture, colour):
    """Texture x colour, in the form that the exporter turns into a base colour factor."""
    if tuple(colour) == (1, 1, 1):
        return texture.outputs["Color"]
    mix = material.node_tree.nodes.new("ShaderNodeMix")
    mix.data_type, mix.blend_type = "RGBA", "MULTIPLY"
    mix.inputs[0].default_value = 1.0
    mix.inputs[7].default_value = (*np.minimum(colour, 1.0), 1.0)
    material.node_tree.links.new(texture.outputs["Color"], mix.inputs[6])
    return mix.outputs[2]


def _plain(name):
    texture, colour, roughness, metallic = PLAIN[name]
    material, shader, links = _start(name, roughness, metallic)
    if texture is None:
        shader.inputs["Base Color"].default_value = (*colour, 1.0)
    else:
        links.new(_tinted(material, _texture(material, texture), colour), shader.inputs["Base Color"])
    return material


def _asphalt(name):
    material, shader, links = _start(name, 0.8, 0)
    links.new(_texture(material, "asphalt").outputs["Color"], shader.inputs["Base Color"])
    split = material.node_tree.nodes.new("ShaderNodeSeparateColor")
    links.new(_texture(material, "asphalt_roughness", True).outputs["Color"], split.inputs[0])
    links.new(split.outputs[1], shader.inputs["Roughness"])
    links.new(split.outputs[2], shader.inputs["Metallic"])
    bump = material.node_tree.nodes.new("ShaderNodeNormalMap")
    links.new(_texture(material, "asphalt_normal", True).outputs["Color"], bump.inputs["Color"])
    links.new(bump.outputs["Normal"], shader.inputs["Normal"])
    return material


def _masked(name):
    material, shader, links = _start(name, 0.9, 0)
    texture = _texture(material, MASKED[name][0])
    links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    links.new(texture.outputs["Alpha"], shader.inputs["Alpha"])
    material.blend_method, material.alpha_threshold = "CLIP", 0.4
    material.use_backface_culling = not MASKED[name][1]
    return material


def _details(name):
    material, shader, links = _start(name, 0.35, 0)
    links.new(_texture(material, "details").outputs["Color"], shader.inputs["Base Color"])
    links.new(_texture(material, "details_glow").outputs["Color"], shader.inputs["Emission"])
    shader.inputs["Emission Strength"].default_value = 1.0
    return material


def _glowing(name):
    material, shader, _ = _start(name, 0.5, 0)
    shader.inputs["Base Color"].default_value = (0.8, 0.8, 0.8, 1)
    shader.inputs["Emission"].default_value = (*GLOWING[name], 1)
    shader.inputs["Emission Strength"].default_value = 1.0
    return material


def get(name):
    """The material of that name, made at first use."""
    if name in bpy.data.materials:
        return bpy.data.materials[name]
    if name == "asphalt":
        return _asphalt(name)
    if name == "details":
        return _details(name)
    return _masked(name) if name in MASKED else _glowing(name) if name in GLOWING else _plain(name)
