"""Renders glTF scenes or arrays to images by bidirectional path tracing.

    import bdpt
    scene = bdpt.load("scene.glb", env="sky.exr")
    render = bdpt.render(scene, spp=64, size=(640, 480))
    render.image            # NumPy array of float32, (height, width, 3)
    render.save("out.exr")
"""

import operator
from typing import Any, Iterator

from ._bdpt import (Camera, DirectionalLight, EnvironmentLight, Error, Instance, InvalidCallError, InvalidValueError,
                    JobImage, JobProgress, Material, Mesh, MissingFileError, OutOfMemoryError, OutputError, PointLight,
                    RayHits, Render, Renderer, Scene, SpotLight, __version__, compare, load, read_part, render, run)
from ._dataset import View, dataset
from ._signatures import with_signature

__all__ = ["Camera", "DirectionalLight", "EnvironmentLight", "Error", "Instance", "InvalidCallError",
           "InvalidValueError", "JobImage", "JobProgress", "Material", "Mesh", "MissingFileError", "OutOfMemoryError",
           "OutputError", "PointLight", "RayHits", "Render", "Renderer", "Scene", "SpotLight", "View", "compare", "dataset", "load",
           "orbit", "read_part", "render", "run"]

load = with_signature(load)
render = with_signature(render)
run = with_signature(run)
Render.save = with_signature(Render.save)  # type: ignore[method-assign]
Render.to_srgb = with_signature(Render.to_srgb)  # type: ignore[method-assign]
Renderer.save = with_signature(Renderer.save)  # type: ignore[method-assign]


def orbit(scene: Scene, views: int, **options: Any) -> Iterator[Render]:
    """Renders a turntable: yields the views 1 to `views` in turn, as bdpt render --orbit makes them.

    Takes the options of render(). For one exposure in all views use save(file, exposure="light").
    """
    last = operator.index(views)
    for view in range(1, max(1, last) + 1):  # render() reports an invalid number of views
        yield render(scene, orbit=last, frames=view, **options)
