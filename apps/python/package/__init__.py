"""Bidirectional path tracing: glTF scenes, or arrays, to images.

    import bdpt
    scene = bdpt.load("scene.glb", env="sky.exr")
    render = bdpt.render(scene, spp=64, size=(640, 480))
    render.image            # NumPy array of float32, (height, width, 3)
    render.save("out.exr")
"""

from ._bdpt import (Camera, DirectionalLight, EnvironmentLight, Error, Material, Mesh, PointLight, Render,
                    Renderer, Scene, SpotLight, __version__, compare, load, read_part, render)
from ._signatures import with_signature

__all__ = ["Camera", "DirectionalLight", "EnvironmentLight", "Error", "Material", "Mesh", "PointLight", "Render",
           "Renderer", "Scene", "SpotLight", "compare", "load", "read_part", "render"]

load = with_signature(load)
render = with_signature(render)
Render.save = with_signature(Render.save)  # type: ignore[method-assign]
Render.to_srgb = with_signature(Render.to_srgb)  # type: ignore[method-assign]
Renderer.save = with_signature(Renderer.save)  # type: ignore[method-assign]
