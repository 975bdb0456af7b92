"""Builds a scene of layered materials and other material extensions."""

from shapes import sphere
from specular_scenes import specular_room


def material_layers(title):
    gltf = specular_room(title, (-1.7, 0, -2), (1.7, 2.4, 2.2), (14, 13, 12))
    solid = {"transmission": {"transmissionFactor": 1}, "volume": {"thicknessFactor": 0.1}}
    balls = (
        ("varnished wood", (0.35, 0.14, 0.05), 0.0, 0.7,
         {"clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1}}),
        ("velvet", (0.12, 0.01, 0.03), 0.0, 1.0,
         {"sheen": {"sheenColorFactor": [0.9, 0.4, 0.5], "sheenRoughnessFactor": 0.4}}),
        ("brushed steel", (0.75, 0.75, 0.78), 1.0, 0.2,
         {"anisotropy": {"anisotropyStrength": 0.8, "anisotropyRotation": 0.5}}),
        ("specular-glossiness gold", (0.1, 0.1, 0.1), 1.0, 1.0,
         {"pbrSpecularGlossiness": {"diffuseFactor": [0, 0, 0, 1], "specularFactor": [1, 0.77, 0.34],
                                    "glossinessFactor": 0.75}}),
        ("soap film on black", (0.02, 0.02, 0.02), 0.0, 0.1,
         {"iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.8, "iridescenceThicknessMaximum": 480}}),
        ("anodised titanium", (0.6, 0.55, 0.5), 1.0, 0.3,
         {"iridescence": {"iridescenceFactor": 1, "iridescenceIor": 2.3, "iridescenceThicknessMaximum": 150}}),
        ("wax", (0.8, 0.55, 0.3), 0.0, 0.4,
         {"diffuse_transmission": {"diffuseTransmissionFactor": 0.7, "diffuseTransmissionColorFactor": [1, 0.8, 0.5]},
          "volume": {"thicknessFactor": 0.1, "attenuationDistance": 0.3, "attenuationColor": [0.9, 0.5, 0.25]}}),
        ("rutile", (1, 1, 1), 0.0, 0.0, {**solid, "ior": {"ior": 2.4}, "dispersion": {"dispersion": 2.04}}),
    )
    positions, triangles, normals = sphere(48, 24, radius=0.26)
    ball = gltf.shape(positions, triangles, normals, [(x, y) for x, y, _ in positions])  # tangents along x
    for i, (name, color, metallic, roughness, extensions) in enumerate(balls):
        row, column = divmod(i, 4)
        material = gltf.material(name, color, metallic=metallic, roughness=roughness, extensions=extensions)
        place = (-0.93 + 0.62 * column, 0.262 if row else 0.6, -0.3 if row else -1.2)
        gltf.node(name, place, mesh=gltf.mesh(name, (ball, material)))
    return gltf


LAYER_SCENES = {
    "material-layers": material_layers,
}
