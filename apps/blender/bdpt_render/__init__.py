"""bdpt in Blender: Render > Render with bdpt exports the scene as GLB, calls the command, and loads its image."""

import json
import pathlib
import shlex
import tempfile

import bpy

from . import command, export

bl_info = {"name": "bdpt", "blender": (4, 2, 0), "category": "Render", "location": "Render > Render with bdpt"}

IMAGE = "bdpt"
INTEGRATORS = [("auto", "Automatic", "Chosen by a short test render"),
               ("bdpt", "Bidirectional", "Bidirectional path tracing"),
               ("mis", "Path tracing", "Path tracing with light and BSDF sampling")]


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: bpy.props.StringProperty(name="Command", subtype="FILE_PATH", default="bdpt",
                                      description="The program bdpt, by its path or found in PATH")

    def draw(self, context):
        self.layout.prop(self, "command")


class Settings(bpy.types.PropertyGroup):
    samples: bpy.props.IntProperty(name="Samples", default=64, min=1, description="Samples per pixel")
    integrator: bpy.props.EnumProperty(name="Integrator", items=INTEGRATORS, default="auto")
    denoise: bpy.props.BoolProperty(name="Denoise", default=False, description="By Open Image Denoise, where it is installed")
    options: bpy.props.StringProperty(name="Options", default="", description="More options of bdpt render, as one types them")


class RenderWithBdpt(bpy.types.Operator):
    """Render what the camera of the scene sees with bdpt"""

    bl_idname = "render.bdpt"
    bl_label = "Render with bdpt"

    def execute(self, context):
        """Waits for the image: from scripts, and without a window."""
        self.start(context)
        try:
            while not self.process.ended():
                self.process.wait(0.1)
            return self.finish(context)
        finally:
            self.clean_up()

    def invoke(self, context, event):
        """Goes on in the background: from the menu. Escape ends it after the pass in flight."""
        self.start(context)
        self.timer = context.window_manager.event_timer_add(0.2, window=context.window)
        context.window_manager.modal_handler_add(self)
        context.window_manager.progress_begin(0, 100)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.process.stop()
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        ended = self.process.ended()
        context.window_manager.progress_update(100 * self.process.fraction)
        if not ended:
            return {"RUNNING_MODAL"}
        context.window_manager.event_timer_remove(self.timer)
        context.window_manager.progress_end()
        try:
            return self.finish(context)
        finally:
            self.clean_up()

    def start(self, context):
        self.folder = tempfile.TemporaryDirectory(prefix="bdpt-")
        folder = pathlib.Path(self.folder.name)
        scene, settings = context.scene, context.scene.bdpt
        words, warnings = export.export_scene(context, folder)
        for warning in warnings:
            self.report({"WARNING"}, warning)
        self.image = folder / "image.exr"
        words += ["--spp", str(settings.samples), "--integrator", settings.integrator, "-o", str(self.image)]
        words += ["--denoise"] if settings.denoise else []
        words += ["--background", "transparent"] if scene.render.film_transparent else []
        words += shlex.split(settings.options)
        self.process = command.Command(program_of(context), words)

    def finish(self, context):
        for warning in self.process.warnings:
            self.report({"WARNING"}, warning)
        if self.process.error:
            self.report({"ERROR"}, self.process.error)
            return {"CANCELLED"}
        if IMAGE in bpy.data.images:
            bpy.data.images.remove(bpy.data.images[IMAGE])
        image = bpy.data.images.load(str(self.image))
        image.name = IMAGE
        image.pack()  # its file goes
        self.report({"INFO"}, f"Image {IMAGE}: {json.dumps(self.process.done)}")
        return {"FINISHED"}

    def clean_up(self):
        self.folder.cleanup()


class Panel(bpy.types.Panel):
    bl_idname = "RENDER_PT_bdpt"
    bl_label = "bdpt"
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        for name in ("samples", "integrator", "denoise", "options"):
            self.layout.prop(context.scene.bdpt, name)
        self.layout.operator(RenderWithBdpt.bl_idname)


def program_of(context):
    addon = context.preferences.addons.get(__package__)
    return addon.preferences.command if addon else "bdpt"


def draw_menu(menu, context):
    menu.layout.operator(RenderWithBdpt.bl_idname)


CLASSES = (Preferences, Settings, RenderWithBdpt, Panel)


def register():
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.bdpt = bpy.props.PointerProperty(type=Settings)
    bpy.types.TOPBAR_MT_render.append(draw_menu)


def unregister():
    bpy.types.TOPBAR_MT_render.remove(draw_menu)
    del bpy.types.Scene.bdpt
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
