"""Converts the camera of a scene: its view, its lens, and the window of the film that is rendered."""

import dataclasses
import math

import numpy as np


@dataclasses.dataclass
class Film:
    """A film of width x height pixels, of which [x0, x1) x [y0, y1) are rendered; row 0 is on top.

    A shifted lens sees a window of a larger film that is centred on the axis of the lens.
    """

    width: int
    height: int
    crop: tuple  # x0, y0, x1, y1

    def words(self):
        words = ["--size", f"{self.width}x{self.height}"]
        whole = self.crop == (0, 0, self.width, self.height)
        return words if whole else words + ["--crop", ",".join(map(str, self.crop))]


def compute_size(render):
    """Returns width and height of the image [pixels], rounded as Blender does."""
    return (max(1, render.resolution_x * render.resolution_percentage // 100),
            max(1, render.resolution_y * render.resolution_percentage // 100))


def make_film(scene, camera):
    width, height = compute_size(scene.render)
    # Blender numbers rows from the bottom.
    left, right, bottom, top = find_border(scene.render, width, height)
    x, y = compute_shift(scene.render, camera)
    left, right = left + abs(x) + x, right + abs(x) + x
    bottom, top = bottom + abs(y) + y, top + abs(y) + y
    width, height = width + 2 * abs(x), height + 2 * abs(y)
    return Film(width, height, (left, height - top, right, height - bottom))


def find_border(render, width, height):
    """Returns left, right, bottom and top [pixels] of the rendered region, in single precision as Blender does."""
    if not render.use_border:
        return 0, width, 0, height
    pixels = lambda share, size: int(np.float32(share) * np.float32(size))
    return (pixels(render.border_min_x, width), pixels(render.border_max_x, width),
            pixels(render.border_min_y, height), pixels(render.border_max_y, height))


def fits_width(render, camera):
    """Returns whether the sensor size spans the width of the image: the camera decides, or else the longer side."""
    width, height = compute_size(render)
    return camera.sensor_fit == "HORIZONTAL" or (camera.sensor_fit == "AUTO" and width >= height)


def compute_shift(render, camera):
    """Returns the lens shift in whole pixels to the right and upwards; rounding costs at most half a pixel."""
    width, height = compute_size(render)
    side = width if fits_width(render, camera) else height
    return round(camera.shift_x * side), round(camera.shift_y * side)


def gltf_camera(scene, camera, matrix):
    """Returns the camera as glTF. `matrix` is the world matrix of its object; focus distances are measured from
    there."""
    render = scene.render
    width, height = compute_size(render)
    film = make_film(scene, camera)
    if camera.type == "PANO":
        raise RuntimeError(f'camera "{camera.name}": bdpt has no panoramic cameras')
    if camera.type not in ("PERSP", "ORTHO"):
        raise RuntimeError(f'camera "{camera.name}": bdpt has no cameras of the type {camera.type}')
    side_height = height / width if fits_width(render, camera) else 1.0  # image height over the sensor's side
    grown = film.height / height
    near_far = {"znear": 0.01, "zfar": 1000.0}  # glTF requires them; bdpt clips nothing
    if camera.type == "ORTHO":
        ymag = camera.ortho_scale * side_height * grown / 2.0
        return {"type": "orthographic", "orthographic": {"xmag": ymag * film.width / film.height, "ymag": ymag, **near_far}}
    vertical = camera.sensor_fit == "VERTICAL"
    sensor = camera.sensor_height if vertical else camera.sensor_width
    yfov = 2.0 * math.atan(sensor * side_height * grown / 2.0 / camera.lens)
    item = {"type": "perspective", "perspective": {"yfov": yfov, "aspectRatio": film.width / film.height, **near_far}}
    if camera.dof.use_dof:
        # Converts the f-number and the focal length [mm] to the radius of the lens [m].
        item["extras"] = {"lensRadius": camera.lens / camera.dof.aperture_fstop / 2000.0,
                          "focusDistance": focus_distance(camera, matrix)}
    return item


def focus_distance(camera, matrix):
    target = camera.dof.focus_object
    if target is None:
        return camera.dof.focus_distance
    place = target.matrix_world
    if target.type == "ARMATURE" and camera.dof.focus_subtarget in target.pose.bones:
        place = place @ target.pose.bones[camera.dof.focus_subtarget].matrix
    return max(1e-5, -(matrix.inverted() @ place.translation).z)


def find_warnings(scene, camera):
    if scene.render.pixel_aspect_x != scene.render.pixel_aspect_y:
        yield "pixels are square in bdpt: the pixel aspect is ignored"
    if camera.type == "ORTHO" and camera.dof.use_dof:
        yield f'camera "{camera.name}": bdpt has no depth of field for orthographic cameras'
    dof = camera.dof
    if camera.type == "PERSP" and dof.use_dof and (dof.aperture_blades or dof.aperture_ratio != 1.0):
        yield f'camera "{camera.name}": the aperture is round'
