"""Defines materials that several scenes use."""

SOLID_GLASS = {"transmission": {"transmissionFactor": 1}, "ior": {"ior": 1.5}, "volume": {"thicknessFactor": 0.1}}
THIN_GLASS = {"transmission": {"transmissionFactor": 1}, "ior": {"ior": 1.5}}


def mirror(gltf, name, color=(0.95, 0.95, 0.95)):
    return gltf.material(name, color, metallic=1, roughness=0)


def glass(gltf, name, absorption=None):
    """Adds smooth, solid glass. `absorption` is (remaining colour of white light, after which distance [m])."""
    volume = dict(SOLID_GLASS["volume"])
    if absorption:
        color, distance = absorption
        volume.update({"attenuationDistance": distance, "attenuationColor": list(color)})
    return gltf.material(name, (1, 1, 1), roughness=0, extensions={**SOLID_GLASS, "volume": volume})
