"""Views of many models, for learning."""

import dataclasses
import glob
import inspect
import os
import pathlib
import warnings
from typing import Any, Iterator, Optional, Sequence, Union

import numpy as np
import numpy.typing as npt

from ._bdpt import Camera, Error, Render, Scene, ModelViews, check_dataset_words, load, render
from ._signatures import with_signature

Range = Union[float, tuple[float, float]]
Path = Union[str, "os.PathLike[str]"]

_VIEW = ("fov", "f_stop", "lens_radius", "focus_distance")  # options of cameras that are drawn here
_USAGE = 2  # code of errors in calls, which the next model has, too
_LOAD = frozenset(inspect.signature(with_signature(load)).parameters) - {"file"}
_RENDER = frozenset(inspect.signature(with_signature(render)).parameters)


@dataclasses.dataclass(frozen=True, repr=False)
class View:
    """One view of a model, from dataset().

    model: its name; file: where it was loaded from; index: number of the view, from 0
    camera: its camera, with `matrix` (camera to world, OpenGL axes) and `intrinsics()`
    render: its Render; `image` is linear radiance, `rgb` 8-bit sRGB, both (height, width, 3)
    layers: arrays by name, for aov=...: "depth", "distance" (height, width) [m], infinite where nothing is
        hit; "normal", "camera-normal", "position" (height, width, 3); "uv" (height, width, 2); for "mask" integers
        "object", "instance", "material" (height, width), 0 where nothing is hit; "flow" (height, width, 2) [pixels] to
        the next view, and "flow_visible", True where the point is visible there. The last view has no flow.
    names: for masks, by kind: names["object"][i] is the name of integer i
    exposure: of rgb [EV], by the light of the model's first view; None: no light falls on it, each view has its own
    """

    model: str
    file: str
    index: int
    scene: Scene
    camera: Camera
    render: Render
    layers: dict[str, npt.NDArray[Any]]
    names: dict[str, list[str]]
    exposure: Optional[float]

    @property
    def image(self) -> npt.NDArray[np.float32]:
        """Linear radiance [nit], (height, width, 3)."""
        return self.render.image

    @property
    def rgb(self) -> npt.NDArray[np.uint8]:
        """Pixels for screens, (height, width, 3), with one exposure for all views of a model."""
        return self.render.to_srgb(exposure=self.exposure)

    def __repr__(self) -> str:
        return f"<bdpt.View {self.index} of {self.model}: {', '.join(['image', *self.layers])}>"


def _text(value: Any) -> str:
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    return ":".join(map(str, value)) if isinstance(value, Sequence) else str(value)


def _files(models: Union[Path, Sequence[Path]]) -> list[str]:
    """Returns the files of names and patterns."""
    files = []
    for model in [models] if isinstance(models, (str, os.PathLike)) else models:
        name = os.fspath(model)
        found = sorted(glob.glob(name)) if glob.has_magic(name) and not os.path.exists(name) else [name]
        if not found:
            raise FileNotFoundError(f"{name}: no file matches")
        files += found
    return files


def dataset(models: Union[Path, Sequence[Path]], views: Optional[int] = None, *,
            view_range: Union[str, tuple[tuple[float, float], tuple[float, float]], None] = None,
            distance: Optional[Range] = None, fov_range: Optional[tuple[float, float]] = None,
            poses: Optional[Path] = None, seed: int = 0, size: Union[int, tuple[int, int], None] = None,
            aov: Union[str, Sequence[str]] = (), root: Optional[Path] = None, on_error: str = "warn",
            **options: Any) -> Iterator[View]:
    """Yields views of models, one model after the other: those of the command bdpt dataset, to the bit.

    models: files, or a pattern like "models/*.glb"
    views: number of views of each, spread over a sphere (default 24)
    view_range: ((azimuth, azimuth), (elevation, elevation)) [degrees] to draw views from instead
    distance: a number or a range; at 1 the bounding sphere just fits
    fov_range: range of vertical fields of view [degrees]; fov=... for a single one
    poses: a transforms.json with cameras, in place of drawn ones
    size: width and height [pixels], or one number for both; default: that of poses, else (512, 512)
    aov: of depth, distance, normal, camera-normal, uv, position, mask, flow: see View.layers
    root: names models by their paths from this folder; else by the names of their files
    on_error: "warn" goes on with the next model if one cannot be loaded or rendered, "raise" raises
    options: those of load() and render(), such as env="studio", spp=32, f_stop=2.8

    Raises ValueError and TypeError for wrong values, FileNotFoundError for a pattern without files, when it is called.
    """
    if on_error not in ("warn", "raise"):
        raise ValueError(f"on_error={on_error!r}: expected 'warn' or 'raise'")
    given = {"views": views, "distance": distance, "fov-range": fov_range, "poses": poses, "seed": seed,
             "size": "x".join(map(str, size)) if isinstance(size, Sequence) else size,
             **{name.replace("_", "-"): options.pop(name, None) for name in _VIEW},
             "aov": aov if isinstance(aov, str) else ",".join(aov),
             "view-range": view_range if view_range is None or isinstance(view_range, str)
             else ",".join(map(_text, view_range))}
    words = [f"--{name}={_text(value)}" for name, value in given.items() if value not in (None, "")]
    check_dataset_words(words)
    of_load = {name: value for name, value in options.items() if name in _LOAD and name not in _RENDER}
    of_render = {name: value for name, value in options.items() if name not in of_load}
    for name in of_render:
        if name not in _RENDER:
            raise TypeError(f"dataset() has no option {name}")
    return _views(_named(models, root), words, of_load, of_render, on_error == "raise")


def _named(models: Union[Path, Sequence[Path]], root: Optional[Path]) -> list[tuple[str, str]]:
    """Returns the names of models and their files."""
    paths = [pathlib.Path(file) for file in _files(models)]
    if root is None:
        return [(path.stem, str(path)) for path in paths]
    base = pathlib.Path(root).resolve()
    return [(path.resolve().relative_to(base).with_suffix("").as_posix(), str(path)) for path in paths]


def _views(models: Sequence[tuple[str, str]], words: list[str], of_load: dict[str, Any], of_render: dict[str, Any],
           raises: bool) -> Iterator[View]:
    for name, file in models:
        try:
            scene = load(file, **of_load)
            model = ModelViews(scene, name, words)
            for index, (camera, seed) in enumerate(zip(model.cameras, model.seeds)):
                picture = render(scene, camera=camera, seed=seed, **of_render)
                layers, names = model.layers(scene, index)
                yield View(name, file, index, scene, camera, picture, layers, names, model.exposure)
        except Error as error:
            if raises or error.code == _USAGE:
                raise
            warnings.warn(str(error), stacklevel=3)
