"""Maps Blender's render passes to the layers of the command's images."""

import dataclasses

import numpy as np

FAR = 1e10  # depth of the background, as in Cycles
CRYPTO_LEVELS = 3  # layers for each kind of id


@dataclasses.dataclass
class Pass:
    name: str
    channels: str   # names of its channels in Blender
    kind: str       # argument of update_render_passes()
    layer: tuple    # channels in the command's EXR
    aov: str = ""   # name for --aov
    fill: float = None  # value where the EXR lacks the channel


COMBINED = Pass("Combined", "RGBA", "COLOR", ("R", "G", "B", "A"), fill=1.0)


def list_passes(scene, layer):
    yield COMBINED
    xyz = lambda name: tuple(f"{name}.{axis}" for axis in "XYZ")
    if layer.use_pass_z:
        yield Pass("Depth", "Z", "VALUE", ("depth.Z",), "depth")
    if layer.use_pass_position:
        yield Pass("Position", "XYZ", "VECTOR", xyz("position"), "position")
    if layer.use_pass_normal:
        yield Pass("Normal", "XYZ", "VECTOR", xyz("normal"), "normal")
    for wanted, kind in ((layer.use_pass_cryptomatte_object, "Object"), (layer.use_pass_cryptomatte_material, "Material")):
        for level in range(CRYPTO_LEVELS if wanted else 0):
            name = f"Crypto{kind}{level:02d}"
            yield Pass(name, "rgba", "COLOR", tuple(f"{name}.{channel}" for channel in "rgba"), kind.lower())
    if layer.bdpt.use_pass_denoising_data:
        if scene.bdpt.denoise:
            yield Pass("Noisy Image", "RGBA", "COLOR", ("noisy.R", "noisy.G", "noisy.B", "A"), fill=1.0)
        yield Pass("Denoising Albedo", "RGB", "COLOR", ("albedo.R", "albedo.G", "albedo.B"), "albedo")
        yield Pass("Denoising Normal", "XYZ", "VECTOR", xyz("normal"), "normal")


def register(engine, scene, layer):
    for item in list_passes(scene, layer):
        engine.register_pass(scene, layer, item.name, len(item.channels), item.channels, item.kind)


def words(scene, layer):
    aovs = sorted({item.aov for item in list_passes(scene, layer) if item.aov})
    return ["--aov", ",".join(aovs)] if aovs else []


def fill(result, scene, layer, exr):
    """Copies the layers of `exr` to the passes of `result`."""
    for item in list_passes(scene, layer):
        target = result.layers[0].passes[item.name]
        pixels = exr.pixels(item.layer, item.fill)
        if item.kind == "VECTOR":
            pixels = np.stack([pixels[..., 0], -pixels[..., 2], pixels[..., 1]], axis=-1)  # converts to z-up
        if item.name == "Depth":
            pixels = np.minimum(pixels, FAR)
        put(target, pixels)


def put_color(result, color):
    """Shows a preview image of (height, width, 3)."""
    opaque = np.ones((*color.shape[:2], 1), np.float32)
    put(result.layers[0].passes["Combined"], np.concatenate([color, opaque], axis=-1))


def put(target, pixels):
    """Copies `pixels`, whose row 0 is on top, to a pass, whose row 0 is at the bottom."""
    values = np.ascontiguousarray(pixels[::-1], np.float32)
    try:
        target.rect.foreach_set(values.ravel())
    except TypeError:  # Blender 3 takes a list of pixels
        target.rect.foreach_set(values.reshape(-1, values.shape[-1]))


def stamp_mattes(result, layer, exr):
    """Adds the metadata in which Cryptomatte nodes look up names: the command's, under Blender's layer names."""
    for key, text in exr.texts.items():
        if key.startswith("cryptomatte/"):
            result.stamp_data_add_field(key, f"{layer.name}.{text}" if key.endswith("/name") else text)


