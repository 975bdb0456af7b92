"""Implements the render engine: exports a frame, runs the command, and loads its image."""

import math
import pathlib
import tempfile
import threading
import time

import bpy

from . import export, passes, settings
from .command import Command, program, split_options, write_job
from .exr import Exr
from .live_image import LiveImage

STEP = 0.1  # [s] between polls of the command
PATIENCE = 30.0  # [s] that a cancelled command may take to finish its pass


class Cancelled(Exception):
    """The user ended the render."""


def call_in_main_thread(function, cancelled):
    """Calls function() in the main thread, the only one that may change Blender's data while its windows are drawn, and
    returns its result. Raises Cancelled if cancelled() holds before the call begins."""
    if threading.current_thread() is threading.main_thread():
        return function()
    outcome, ended, turn = [], threading.Event(), threading.Lock()  # whoever acquires `turn` decides

    def run():
        if turn.acquire(blocking=False):
            try:
                outcome.append((function(), None))
            except Exception as error:  # raised again in the waiting thread
                outcome.append((None, error))
            ended.set()

    bpy.app.timers.register(run)
    while not ended.wait(0.05):
        # A user who cancels may block the main thread until this thread ends.
        if cancelled() and turn.acquire(blocking=False):
            raise Cancelled
    value, error = outcome[0]
    if error:
        raise error
    return value


class BDPT_RenderEngine(bpy.types.RenderEngine):
    bl_idname = "BDPT"
    bl_label = "bdpt"
    bl_use_preview = False
    bl_use_postprocess = True
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False

    def update_render_passes(self, scene=None, renderlayer=None):
        passes.register(self, scene, renderlayer)

    def render(self, depsgraph):
        """Renders a frame. Every error is reported to the user and ends the render, and an animation too."""
        try:
            with tempfile.TemporaryDirectory(prefix="bdpt-") as folder:
                self._render(depsgraph, pathlib.Path(folder))
        except Cancelled:
            pass
        except (RuntimeError, OSError) as error:
            self.report_to_user("ERROR", str(error))

    def _render(self, depsgraph, folder):
        scene = depsgraph.scene
        check(scene)
        self.update_stats("", "bdpt: exporting")
        exported = self._exported(depsgraph, folder)
        for warning in dict.fromkeys(exported.warnings):
            self.report_to_user("WARNING", warning)
        image = folder / "image.exr"
        # What the scene says is a job, because scenes come from strangers, too.
        job = folder / "job.json"
        write_job(job, exported.file, [*exported.words(), *list_options(scene)])
        words = [str(job), *denoiser_words(scene), *passes.words(scene, depsgraph.view_layer_eval), "-o", str(image)]
        command = self._run(words, exported.film, depsgraph.view_layer_eval)
        for warning in command.warnings:
            self.report_to_user("WARNING", warning)
        if command.error:
            raise RuntimeError(command.error)
        if not image.exists():
            raise Cancelled
        exr = Exr(image)
        result = self._begin(depsgraph.view_layer_eval, exr.width, exr.height)
        passes.fill(result, scene, depsgraph.view_layer_eval, exr)
        self.end_result(result)
        passes.stamp_mattes(self.get_result(), depsgraph.view_layer_eval, exr)
        if command.done:
            self.report_to_user("INFO", command.sentence())

    def _exported(self, depsgraph, folder):
        """Exports the scene at all moments of the shutter, then returns the dependency graph to its frame."""
        scene = depsgraph.scene
        frame = scene.frame_current_final
        times = export.shutter_times(scene.render)
        exported = None
        try:
            for moment in times:
                if len(times) > 1:
                    self._go_to(frame + moment)
                if exported is None:
                    exported = call_in_main_thread(lambda: export.Export(depsgraph, folder), self._cancelled)
                else:
                    exported.place(depsgraph)
        finally:
            if len(times) > 1:
                self._go_to(frame)
        exported.write()
        return exported

    def report_to_user(self, kind, text):
        self.report({kind}, text)

    def _cancelled(self):
        return self.test_break()

    def _go_to(self, frame):
        whole = math.floor(frame)
        self.frame_set(whole, frame - whole)

    def _run(self, words, film, layer):
        live = None if bpy.app.background else LiveImage()
        command = Command(program(settings.chosen_command()), words + (["--display", live.address] if live else []))
        try:
            stopped, told = None, None
            while not command.ended():
                command.wait(STEP)
                if command.samples != told:
                    told = command.samples
                    self.update_progress(command.fraction)
                    self.update_stats("", f"bdpt: {told} samples per pixel")
                if live and stopped is None:
                    self._show(live, film, layer)
                if stopped is None and self._cancelled():
                    command.stop()
                    stopped = time.monotonic()
                if stopped is not None and time.monotonic() - stopped > PATIENCE:
                    raise Cancelled
            return command
        finally:
            command.kill()  # if it still runs
            if live:
                live.close()

    def _show(self, live, film, layer):
        pixels = live.take()
        if pixels is None:
            return
        x0, y0, x1, y1 = film.crop
        result = self._begin(layer, x1 - x0, y1 - y0)
        passes.put_color(result, pixels[y0:y1, x0:x1])
        self.end_result(result)

    def _begin(self, layer, width, height):
        return self.begin_result(0, 0, width, height, layer=layer.name)


def check(scene):
    """Raises an error for scenes that bdpt cannot render."""
    if scene.camera is None:
        raise RuntimeError(f'scene "{scene.name}" has no camera')
    if scene.camera.type != "CAMERA":
        raise RuntimeError(f'scene "{scene.name}": its camera "{scene.camera.name}" is a {scene.camera.type.lower()}, no camera')
    if scene.render.use_multiview:
        raise RuntimeError(f'scene "{scene.name}": bdpt has no stereoscopy')


def list_options(scene):
    """Returns the options of `bdpt render` that follow from the settings of the scene."""
    chosen = scene.bdpt
    words = ["--spp", str(chosen.samples), "--integrator", chosen.integrator, "--max-depth", str(chosen.max_depth)]
    words += ["--time", f"{chosen.time:g}s"] if chosen.time > 0.0 else []
    words += ["--noise", f"{chosen.noise:g}%"] if chosen.noise > 0.0 else []
    words += ["--background", "transparent"] if scene.render.film_transparent else []
    return words + split_options(chosen.options)


def denoiser_words(scene):
    """Returns the options of `bdpt render` that decide whether it denoises, as the scene asks."""
    if not scene.bdpt.denoise:
        return ["--denoise=false"]
    library = denoiser_of_blender()
    return ["--denoise", *(["--denoiser-library", str(library)] if library else [])]


def denoiser_of_blender():
    """Returns the folder of the Open Image Denoise library that Blender or its module ships; None if it uses the
    system's."""
    version = bpy.utils.resource_path("LOCAL")  # the folder beside that of the libraries
    folder = pathlib.Path(version).parent / "lib"
    return folder if version and any(folder.glob("libOpenImageDenoise.so.2*")) else None


def register():
    bpy.utils.register_class(BDPT_RenderEngine)


def unregister():
    bpy.utils.unregister_class(BDPT_RenderEngine)
